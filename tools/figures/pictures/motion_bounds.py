"""Bounds of a moving point's height above a plane, and a plane that turns with a body
(docs/motion-bounds.md).

The bounds are those of src/rigid/motion: of first order (speeds), of second order (the velocity now
and a bound of its change), and that of a plane that turns with the body a.
"""
import math

from drawing import Drawing, View
from geometry import add, left_of, length, mul, sub, turned

# One point of a turning body above a plane at rest.
CENTER, ARM, VELOCITY, SPIN = (0.0, 2.0), (0.3, -1.0), (0.6, -1.2), 0.8

# A long bar a that turns, and a small body b that falls towards it.
HALF, THICK, TURN = 2.1, 0.22, -0.36
B_AT, B_SIZE, FALL, GAP = 1.55, 0.4, (0.0, -0.95), 0.25


def height(s):
    return CENTER[1] + s * VELOCITY[1] + turned(ARM, SPIN * s)[1]


def bounds_at(s):
    """Lower bounds of first and of second order."""
    rho = length(ARM)
    slope = VELOCITY[1] + SPIN * left_of(ARM)[1]
    return (height(0) + s * (VELOCITY[1] - SPIN * rho),
            height(0) + s * slope - s * s / 2 * SPIN * SPIN * rho)


def first_zero(f, end=6.0, steps=6000):
    return next(end * k / steps for k in range(steps) if f(end * k / steps) <= 0)


def draw_heights(d):
    d.text(150, 20, "One point above a plane", anchor="middle", size="head")
    left, base, wide, tall = 30, 248, 122, 150
    rows = [(lambda s: bounds_at(s)[0], "violet"),
            (lambda s: bounds_at(s)[1], "green"), (height, "blue")]

    def at(s, h):
        return left + wide * s, base - tall * h

    d.arrow((left, base), (left, 50), "muted")
    d.arrow((left, base), (284, base), "muted")
    d.text(left - 4, 44, "height", "muted", size="small")
    d.text(284, base + 20, "time s", "muted", anchor="end", size="small")
    for f, color in rows:
        end = first_zero(f)
        d.polyline([at(end * k / 40, f(end * k / 40)) for k in range(41)], color, width="bold")
        d.dot((left + wide * end, base), color, 4.5)
    d.line((152, 78), (180, 78), "blue", width="bold")
    d.text(186, 83, "true height", "blue", size="small")
    d.line((152, 102), (180, 102), "green", width="bold")
    d.text(186, 107, "second order", "green", size="small")
    d.line((152, 126), (180, 126), "violet", width="bold")
    d.text(186, 131, "first order", "violet", size="small")


def bar_at(s):
    corners = [(-HALF, -THICK), (HALF, -THICK), (HALF, 0), (-HALF, 0)]
    return [turned(p, TURN * s) for p in corners]


def body_at(s):
    low = add((B_AT, GAP), mul(s, FALL))
    return [add(low, p) for p in ((0, 0), (B_SIZE, 0), (B_SIZE, B_SIZE), (0, B_SIZE))]


def free_time(gap, closing, bend, fastest):
    root = math.sqrt(closing * closing + 2 * bend * gap)
    second = 2 * gap / (closing + root) if closing > 0 else (root - closing) / bend
    return max(second, gap / fastest)


def fixed_plane():
    """How long the plane y = const parts the two: the least time of two vertices."""
    times = []
    for p in bar_at(0):
        for q in body_at(0):
            closing = TURN * left_of(p)[1] - FALL[1]
            arm = length(p)
            times.append(free_time(q[1] - p[1], closing, TURN * TURN * arm,
                                   abs(TURN) * arm - FALL[1]))
    return min(times)


def turning_plane():
    """How long b stays above the plane of a's upper side, which turns with a."""
    times = []
    for q in body_at(0):
        u = sub(FALL, mul(TURN, left_of(q)))
        horizon = 1.0
        most = length(FALL) + abs(TURN) * (length(q) + horizon * length(FALL))
        bend = abs(TURN) * (length(FALL) + most)
        times.append(min(horizon, free_time(q[1], -u[1], bend, math.inf)))
    return min(times)


def contact():
    """When a corner of b reaches the bar's upper side."""
    def least(s):
        return min(turned(q, -TURN * s)[1] for q in body_at(s))
    return first_zero(least, 2.0)


def draw_planes(d):
    d.text(444, 20, "A plane that turns with a", anchor="middle", size="head")
    view = View((440, 118), 66)
    fixed, turning = fixed_plane(), turning_plane()
    assert fixed < turning < contact()
    for s, style in ((0, {"dash": True, "width": "thin"}), (turning, {})):
        d.polygon(view.all(bar_at(s)), "blue", tint=None if s == 0 else "blue", **style)
        d.polygon(view.all(body_at(s)), "orange", tint=None if s == 0 else "orange", **style)
    d.line(view((-HALF - 0.1, GAP / 2)), view((HALF + 0.1, GAP / 2)), "violet", width="thin")
    top = bar_at(turning)
    way = mul(1 / (2 * HALF), sub(top[2], top[3]))
    lift = mul(0.03, left_of(way))
    d.line(view(add(add(top[3], mul(-0.1, way)), lift)), view(add(add(top[2], mul(0.1, way)), lift)),
           "green", width="bold")
    x, y = view(turned((-1.0, -THICK), TURN * turning))
    d.text(x, y + 22, "a", "blue", anchor="middle", bold=True)
    x, y = view(body_at(turning)[2])
    d.text(x + 8, y + 14, "b", "orange", bold=True)
    left, base, wide = 318, 236, 270 / 0.85
    for row, (time, color, name) in enumerate(((fixed, "violet", "at rest"),
                                               (turning, "green", "turning"))):
        y = base - 44 + 24 * row
        d.rect(left, y, wide * time, 14, color, tint=color)
        d.text(left + wide * time + 8, y + 13, name, color, size="small")
    x = left + wide * contact()
    d.line((x, base - 52), (x, base + 8), width="bold")
    d.text(left + wide * contact() + 4, base + 26, "contact", anchor="end", size="small")
    d.line((left, base + 8), (588, base + 8), "muted")


def draw():
    d = Drawing(286, "Bounds of a height over time, and a plane that turns with a body")
    draw_heights(d)
    draw_planes(d)
    return d
