"""Conservative advancement of a turning polygon towards one at rest (docs/time-of-impact.md).

In each step the closest points give a direction n. Each vertex then has two times before which it
cannot reach the plane: of first order (speeds) and of second order (velocities and the turn). The
longer one counts, as in `free_time` of src/rigid/motion/motion_bounds.h.
"""
import math

from drawing import Drawing, View
from geometry import add, closest_points, dot, left_of, length, lerp, mul, sub, turned, unit

STILL = [(0.0, -1.0), (1.0, -1.1), (1.55, 0.1), (0.7, 1.05), (-0.35, 0.55)]
BODY = [(-1.15, -0.3), (1.15, -0.22), (1.05, 0.26), (-1.05, 0.3)]
START, VELOCITY, SPIN = (-4.3, 0.75), (3.6, -1.44), 2.88
STEPS = 3
LABELS = [(0.8, 0, 18), (0.5, 4, -8), (0.5, -4, -8)]  # along each gap, and aside


def body_at(t):
    return [add(add(START, mul(t, VELOCITY)), turned(p, SPIN * t)) for p in BODY]


def free_time(t):
    """Closest points at t, and a time during which the polygons certainly stay apart."""
    body = body_at(t)
    p, q = closest_points(body, STILL)
    n = unit(sub(p, q))
    level = max(dot(n, x) for x in STILL)
    center = add(START, mul(t, VELOCITY))
    times = []
    for x in body:
        height, arm = dot(n, x) - level, sub(x, center)
        reach = length(arm)
        first = SPIN * reach - dot(n, VELOCITY)  # largest speed towards the plane
        slope = -dot(n, VELOCITY) - dot(n, mul(SPIN, left_of(arm)))
        bend = SPIN * SPIN * reach  # slope s + bend s^2 / 2 = height
        root = slope * slope + 2 * bend * height
        second = (math.sqrt(root) - slope) / bend
        times.append(max(height / first if first > 0 else math.inf, second))
    return p, q, min(times)


def draw():
    d = Drawing(430, "Conservative advancement in three steps")
    times = [0.0]
    while math.dist(*free_time(times[-1])[:2]) > 1e-7:
        times.append(times[-1] + free_time(times[-1])[2])
    contact = times[-1]
    view = View((448, 138), 76)
    d.polygon(view.all(STILL), "orange", tint="orange")
    d.text(*view((0.5, -0.1)), "B", "orange", bold=True)
    for k in range(STEPS + 1):
        body = body_at(times[k])
        d.polygon(view.all(body), "blue", tint="blue", width="bold" if k == 0 else "line")
        if k > 0:
            x, y = max(view.all(body), key=lambda p: p[1])
            d.text(x, y + 20, f"t_{k}", "blue", anchor="middle")
    for k in range(STEPS + 1):
        p, q, _ = free_time(times[k])
        d.line(view(p), view(q), "green", width="bold" if k == STEPS else "line")
        d.dot(view(p), "green", 3)
        d.dot(view(q), "green", 3)
        if k < STEPS:
            x, y = view(lerp(p, q, LABELS[k][0]))
            d.text(x + LABELS[k][1], y + LABELS[k][2], f"d_{k}", "green", anchor="middle")
    d.text(*view(add(START, (-0.1, -0.08))), "A", "blue", bold=True)

    left, wide, y = 40, 520, 338
    d.line((left, y), (left + wide, y), "muted")
    at = [left + wide * t for t in times]
    for k in range(STEPS):
        d.rect(at[k], y - 12, at[k + 1] - at[k], 12, "blue", tint="blue")
    for k in range(STEPS + 1):
        d.line((at[k], y - 20), (at[k], y + 6), "blue")
        if k < STEPS:
            d.text(at[k], y + 26, f"t_{k}", anchor="middle")
    d.text(at[STEPS] - 3, y + 26, f"t_{STEPS}", anchor="middle")
    x = left + wide * contact
    d.line((x, y - 20), (x, y + 6), "orange", width="bold")
    d.text(x + 6, y - 26, "first contact", "orange", anchor="middle", size="small")
    d.text((at[0] + at[STEPS]) / 2, y - 26, "proven free", "blue", anchor="middle", size="small")
    d.text(left + wide, y + 26, "t = 1", "muted", anchor="end", size="small")
    d.text(300, 396, "In each step, the distance d and bounds on the motion along it prove a time",
           anchor="middle", color="muted", size="small")
    d.text(300, 416, "in which A and B stay apart. No step passes the first contact.",
           anchor="middle", color="muted", size="small")
    return d
