"""Depth and separating translation: equal for a shallow overlap, far apart for a bar through a wall
(docs/penetration.md)."""
import math

from drawing import Drawing, View
from geometry import deepest_point, lerp, sub

WALL = [(-1.6, -0.5), (1.6, -0.5), (1.6, 0.1), (-1.6, 0.1)]
BAR = [(-0.22, -1.15), (0.22, -1.15), (0.22, 1.25), (-0.22, 1.25)]
BALL = [(0.9 * math.cos(2 * math.pi * i / 72), 0.72 + 0.9 * math.sin(2 * math.pi * i / 72))
        for i in range(72)]


def moved(polygon, by):
    return [(x, y + by) for x, y in polygon]


def panel(d, x, head, other, texts):
    d.text(x, 22, head, anchor="middle", size="head")
    view = View((x, 190), 56)
    ends = max((e for e in (deepest_point(other, WALL), deepest_point(WALL, other)) if e),
               key=lambda e: math.dist(*e))
    separation = max(p[1] for p in WALL) - min(p[1] for p in other)  # upwards
    assert separation >= math.dist(*ends) - 1e-3
    d.polygon(view.all(moved(other, separation)), "orange", width="thin", dash=True)
    d.polygon(view.all(WALL), "blue", tint="blue")
    d.polygon(view.all(other), "orange", tint="orange")
    right, low = max(p[0] for p in other), min(p[1] for p in other)
    d.line(view((right, low)), view((1.9, low)), "faint", width="thin")
    d.arrow(view((1.9, low)), view((1.9, low + separation)), "green")
    d.text(view((1.9, 0))[0], view((0, low + separation))[1] - 10, "separation", "green", anchor="middle", size="small")
    d.line(*view.all(ends), "violet", width="bold")
    for p in ends:
        d.dot(view(p), "violet")
    d.text(view((-1.75, 0))[0], view(lerp(*ends, 0.5))[1] + 5, "depth", "violet", anchor="end", size="small")
    d.line(view((-1.72, lerp(*ends, 0.5)[1])), view(lerp(*ends, 0.5)), "violet", width="thin", dash=True)
    d.lines(x, 296, texts, anchor="middle", color="muted", size="small")


def draw():
    d = Drawing(326, "Depth and separating translation of a ball and of a bar in a wall")
    panel(d, 150, "A shallow overlap", BALL, ["The shortest translation that", "separates is the depth."])
    panel(d, 450, "A bar through a wall", BAR, ["Half of the wall deep;", "it must be pulled out to its end."])
    return d
