"""Advancement of a moving patch towards the ball of radius D around the origin
(docs/elementary-thickness.md).

In the plane the patch is a segment. The steps are those of src/ccd/conservative_advancement.cpp: a
direction that turns from the nearest point's now to the one then, if the corners' Bernstein
coefficients prove it; else the time that the direction of now alone proves.
"""
import math

from drawing import Drawing, View
from geometry import add, dot, left_of, length, lerp, mul, nearest_on_segment, unit

START = (2.81, 0.59), (1.05, 1.94)
END = (-0.05, -1.08), (1.74, -1.39)
D, TOLERANCE = 1.0, 0.02  # the tolerance is 1e-6 in the code
CLEAR, NEAR = D, D * (1 + TOLERANCE)
AIM = 0.5 * (CLEAR + NEAR)


class Moment:
    def __init__(self, t):
        self.t = t
        self.corners = [lerp(p, q, t) for p, q in zip(START, END)]
        self.nearest = nearest_on_segment((0, 0), *self.corners)
        self.distance = length(self.nearest)
        self.n = unit(self.nearest)


def is_clear(now, n0, then, n1):
    for c0, c1 in zip(now.corners, then.corners):
        b0, b2 = dot(n0, c0) - CLEAR, dot(n1, c1) - CLEAR
        b1 = 0.5 * (dot(n0, c1) + dot(n1, c0)) - CLEAR
        if not (b0 > 0 and b2 > 0 and (b1 >= 0 or b1 * b1 < 0.999 * b0 * b2)):
            return False
    return True


def clear_until(now):
    """The time until which the direction of now's nearest point keeps the patch clear."""
    part = 1.0
    for c, end in zip(now.corners, END):
        here, there = dot(now.n, c), dot(now.n, end)
        if there <= CLEAR:
            part = min(part, (here - CLEAR) / (here - there))
    return now.t + part * (1 - now.t)


def advance(now, longest):
    """The next moment, and whether the direction turns on the way."""
    sure, tries = clear_until(now), 0
    along = dot(now.nearest, now.n)
    (a0, b0), (a1, b1) = START, END
    edge = math.dist(*now.corners)
    share = math.dist(now.corners[0], now.nearest) / edge
    velocity = lerp(add(a1, mul(-1, a0)), add(b1, mul(-1, b0)), share)
    approach = -dot(now.n, velocity)
    t = min(now.t + (along - AIM) / approach if approach > 0 else 1, now.t + longest, 1)
    while t > sure:
        then = Moment(t)
        if is_clear(now, now.n, then, then.n):
            return then, True
        here, there = now.distance - AIM, then.distance - AIM
        part = here / (here - there) if there < 0 else 0.5
        t = now.t + (part if tries < 4 else min(part, 0.5)) * (t - now.t)
        tries += 1
    return Moment(sure), False


def steps():
    now, moments, longest = Moment(0), [], 1
    while now.distance > NEAR:
        moments.append(now)
        then, turns = advance(now, longest)
        assert turns and then.t > clear_until(now)
        longest, now = 8 * (then.t - now.t), then
    return moments + [now]


def draw():
    d = Drawing(440, "A moving patch advances towards the ball around the origin in proven steps")
    moments = steps()
    view = View((118, 208), 92)
    d.circle(view((0, 0)), 92 * D, "orange", tint="orange")
    d.dot(view((0, 0)), "orange")
    d.text(view((0, 0))[0] - 10, view((0, 0))[1] + 5, "0", "orange", anchor="end")
    d.arrow(view((0, 0)), view((D * math.cos(2.4), D * math.sin(2.4))), "orange")
    d.text(*view((-0.5, 0.18)), "D", "orange", anchor="end", bold=True)
    for k in (0, 1):
        d.line(view(START[k]), view(moments[-1].corners[k]), "faint", width="thin", dash=True)
    for k, now in enumerate(moments):
        d.line(*view.all(now.corners), "blue", width="bold")
        corner, right, down = ((0, 8, 12), (1, -22, 10), (1, 6, 8))[k]
        x, y = view(now.corners[corner])
        d.text(x + right, y + down, f"t_{k}", "blue", bold=True)
        d.dot(view(now.nearest), "green", 3)
        side, foot = left_of(now.n), mul(D, now.n)
        d.arrow(view(mul(0.62, foot)), view(foot), "green")
        if k == 0:
            d.line(view(add(foot, mul(-1.35, side))), view(add(foot, mul(0.7, side))), "green",
                   width="thin")
        x, y = view(mul(0.47, foot))
        d.text(x, y + 5, f"n_{k}", "green", anchor="middle", bold=True)
    fixed = Moment(clear_until(moments[0]))
    d.line(*view.all(fixed.corners), "violet", dash=True)
    d.lines(404, 40, ["The patch (blue) when", "each step begins."], color="muted", size="small")
    d.lines(404, 200, ["Dashed: how far the", "plane across n_0 proves", "it clear."], color="violet",
            size="small")

    left, wide, y = 40, 520, 372
    d.line((left, y), (left + wide, y), "muted")
    for k, now in enumerate(moments):
        x = left + wide * now.t
        d.line((x, y - 34), (x, y + 6), "blue")
        d.text(x, y + 24, f"t_{k}", "blue", anchor="middle")
        if k + 1 < len(moments):
            d.rect(x, y - 32, wide * (moments[k + 1].t - now.t), 14, "green", tint="green")
            d.rect(x, y - 15, wide * (clear_until(now) - now.t), 14, "violet", tint="violet")
    d.text(left + wide * moments[-1].t + 12, y - 20, "turning direction", "green", size="small")
    d.text(left + wide * moments[-1].t + 12, y - 3, "fixed direction", "violet", size="small")
    d.text(left + wide, y + 24, "t = 1", "muted", anchor="end", size="small")
    d.text(300, 428, "Each step is proven clear of the ball. The search ends next to it, at t_2.",
           anchor="middle", color="muted", size="small")
    return d
