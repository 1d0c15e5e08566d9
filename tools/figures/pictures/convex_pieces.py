"""Two solids as unions of convex pieces, hulls around them, and the pair that decides the distance
(docs/convex-pieces.md)."""
import math

from drawing import Drawing, View
from geometry import add, closest_points, contains, convex_hull, edges, lerp, turned


def bracket():
    """A U of three boxes."""
    boxes = [((-1.7, -1), (-1.15, 1.2)), ((-1.15, -1), (0.85, -0.45)), ((0.85, -1), (1.4, 0.85))]
    return [[(x0, y0), (x1, y0), (x1, y1), (x0, y1)] for (x0, y0), (x1, y1) in boxes]


def star():
    """A hub and four teeth."""
    hub = [(0.55 * math.cos(math.pi / 4 * (2 * i + 1)), 0.55 * math.sin(math.pi / 4 * (2 * i + 1))) for i in range(4)]
    pieces = [hub]
    for i in range(4):
        tooth = [(0.389, -0.24), (0.88, -0.14), (0.88, 0.14), (0.389, 0.24)]
        pieces.append([turned(p, math.pi / 2 * i) for p in tooth])
    return [[add((-0.08, 0.86), turned(p, 0.5)) for p in piece] for piece in pieces]


def draw():
    d = Drawing(300, "Two solids of convex pieces, hulls of hulls, and the closest pair of pieces")
    a, b = bracket(), star()
    found = [(closest_points(p, q), p, q) for p in a for q in b]
    assert not any(contains(p, v) for p in a for q in b for v in q)
    (ends, near_a, near_b) = min(found, key=lambda each: math.dist(*each[0]))
    view = View((162, 172), 86)
    for pieces, color in ((a, "blue"), (b, "orange")):
        d.polygon(view.all(convex_hull([p for piece in pieces for p in piece])), color, width="thin", dash=True)
        for piece in pieces:
            near = piece in (near_a, near_b)
            d.polygon(view.all(piece), color, tint=color, width="bold" if near else "line")
    d.line(*view.all(ends), "green", width="bold")
    for p in ends:
        d.dot(view(p), "green")
    d.lines(330, 70, ["Pieces stay inside of their solid.", "So the nearest two pieces (green)",
                      "are as near as the solids are."], size="small")
    d.lines(330, 150, ["Hulls of pieces (dashed) reach", "into hollows. They bound the",
                       "distance from below: hulls that", "are farther apart than the best",
                       "two pieces are never opened."], color="muted", size="small")
    return d
