"""The kinds of clash as small scenes in section (docs/clash.md).

Depths and distances are computed: the local penetration is the largest distance from a point of one
solid's surface inside the other to that one's surface, the larger of both ways.
"""
import math

from drawing import Drawing, View
from geometry import add, closest_points, contains, deepest_point, lerp, turned

CLEARANCE = 0.5
WALL = [(-1.3, -0.9), (1.3, -0.9), (1.3, 0.0), (-1.3, 0.0)]


def box(center, half, angle=0.0):
    return [add(center, turned(p, math.radians(angle)))
            for p in ((-half[0], -half[1]), (half[0], -half[1]), (half[0], half[1]),
                      (-half[0], half[1]))]


def disc(center, radius, sides=20):
    return [add(center, (radius * math.cos(2 * math.pi * i / sides),
                         radius * math.sin(2 * math.pi * i / sides))) for i in range(sides)]


SCENES = [
    ("hard", WALL, box((0.15, 0.35), (0.75, 0.5), 24),
     ["surfaces meet, deeper", "than the tolerance"]),
    ("touch", WALL, box((0.0, 0.45), (0.8, 0.45)),
     ["surfaces meet, at most", "the tolerance deep"]),
    ("contained", box((0, 0), (1.3, 0.95)), disc((-0.35, 0.1), 0.42),
     ["inside a solid,", "no surfaces meet"]),
    ("duplicate", disc((0, 0), 0.9, 6), disc((0, 0), 0.9, 6),
     ["the same triangles", "at the same place"]),
    ("clearance", WALL, disc((0.1, 0.81), 0.5), ["no contact, nearer", "than the clearance"]),
    ("no clash", box((0, -0.55), (1.3, 0.35)), disc((0.1, 0.82), 0.4),
     ["the clearance apart", "or farther"]),
]


def draw():
    d = Drawing(500, "Kinds of clash: hard, touch, contained, duplicate, clearance, and none")
    for i, (name, a, b, texts) in enumerate(SCENES):
        x, y = 100 + 200 * (i % 3), 112 + 256 * (i // 3)
        view = View((x, y), 62)
        d.text(x, y - 92, name, "muted" if name == "no clash" else "ink", anchor="middle",
               size="head")
        if name in ("clearance", "no clash"):
            top = max(p[1] for p in a) + CLEARANCE
            d.line(view((-1.3, top)), view((1.3, top)), "muted", width="thin", dash=True)
        d.polygon(view.all(a), "blue", tint="blue", width="bold" if name == "duplicate" else "line")
        d.polygon(view.all(b), "orange", tint="orange", dash=name == "duplicate",
                  width="bold" if name == "duplicate" else "line")
        ends, label = None, ""
        if name == "hard":
            ends = max((deepest_point(b, a), deepest_point(a, b)), key=lambda e: math.dist(*e))
            label = "depth"
        elif name in ("contained", "clearance", "no clash"):
            assert contains(a, b[0]) == (name == "contained")
            ends = closest_points(a, b)
            near = math.dist(*ends) < CLEARANCE
            assert name == "contained" or near == (name == "clearance")
            label = "gap"
        if ends:
            p, q = view.all(ends)
            d.line(p, q, "ink", width="bold")
            d.dot(p, "ink", 3.5)
            d.dot(q, "ink", 3.5)
            middle = lerp(p, q, 0.5)
            at_left = name == "hard"
            d.text(middle[0] + (-8 if at_left else 8), middle[1] + 5, label,
                   anchor="end" if at_left else "start", size="small")
        if name == "touch":
            d.line(*view.all([(-0.8, 0.0), (0.8, 0.0)]), "ink", width="bold")
        d.lines(x, y + 82, texts, anchor="middle", size="small")
        value = {"hard": "distance = − depth", "contained": "distance = − gap",
                 "clearance": "distance = gap", "no clash": "not reported"}
        d.text(x, y + 123, value.get(name, "distance = 0"), "muted", anchor="middle", size="small")
    return d
