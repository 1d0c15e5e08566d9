"""How a surface falls into patches whose hulls stay inside the solid (docs/convex-pieces-proofs.md).

The solid is a polygon, its edges stand for triangles. Patches grow as in
src/pieces/decomposition/decompose.cpp: breadth first, and an edge joins if the patch stays on its
hull and no other edge enters the hull.
"""
import math

from drawing import Drawing, View
from geometry import contains, convex_hull, cross, edges, sub

SLOT = 0.3


def solid():
    """A ring with a slot."""
    end = math.asin(SLOT / 1.5)
    angles = [end + (2 * math.pi - 2 * end) * k / 11 for k in range(12)]
    return [(1.5 * math.cos(a), 1.5 * math.sin(a)) for a in angles] + [(-0.35, -SLOT), (-0.35, SLOT)]


def in_front(edge, p):
    return cross(sub(edge[1], edge[0]), sub(p, edge[0])) < -1e-12


def enters(hull, edge):
    """Whether an edge has points strictly inside a convex polygon."""
    low, high = 0.0, 1.0
    for a, b in edges(hull):
        h, k = (cross(sub(b, a), sub(p, a)) - 1e-9 for p in edge)
        if h <= 0 and k <= 0:
            return False
        if h < 0:
            low = max(low, h / (h - k))
        elif k < 0:
            high = min(high, h / (h - k))
    return low < high


def decompose(polygon):
    """The patches, as lists of edges."""
    sides, count = edges(polygon), len(polygon)
    piece_of, patches = [None] * count, []
    for seed in range(count):
        if piece_of[seed] is not None:
            continue
        number, patch, tried = len(patches), [seed], {seed}
        piece_of[seed] = number
        for e in patch:
            for other in ((e + 1) % count, (e - 1) % count):
                if piece_of[other] is not None or other in tried:
                    continue
                tried.add(other)
                corners = {p for k in patch + [other] for p in sides[k]}
                if any(in_front(sides[k], p) for k in patch + [other] for p in corners):
                    continue
                hull = convex_hull(list(corners))
                if any(enters(hull, sides[k]) for k in range(count) if k not in patch + [other]):
                    continue
                patch.append(other)
                piece_of[other] = number
        patches.append(patch)
    return patches


def draw_refusal(d, polygon):
    """A patch that lies on its hull, although the hull leaves the solid."""
    d.text(150, 22, "A hull that leaves the solid", anchor="middle", size="head")
    view = View((150, 172), 84)
    sides = edges(polygon)
    outer = range(len(polygon) - 3)
    corners = [p for k in outer for p in sides[k]]
    assert not any(in_front(sides[k], p) for k in outer for p in corners)
    hull = convex_hull(corners)
    d.polygon(view.all(polygon), "muted", tint="ink", width="thin")
    d.polygon(view.all(hull), "orange", tint="orange", dash=True)
    for k, side in enumerate(sides):
        enters_it = k not in outer and enters(hull, side)
        d.line(*view.all(side), "violet" if enters_it else "blue", width="bold")
    body = [(0.3, -0.16), (0.62, -0.16), (0.62, 0.16), (0.3, 0.16)]
    assert all(contains(hull, p) and not contains(polygon, p) for p in body)
    d.polygon(view.all(body), "green", tint="green")
    d.text(*view((0.46, -0.06)), "T", "green", anchor="middle", bold=True)
    d.lines(150, 326, ["The blue patch lies on its hull, but", "edges (violet) enter it, and T meets it."],
            anchor="middle", color="muted", size="small")


def draw_pieces(d, polygon, patches):
    d.text(450, 22, "Hulls of the patches", anchor="middle", size="head")
    view = View((450, 172), 84)
    sides = edges(polygon)
    d.polygon(view.all(polygon), "muted", tint="ink", width="thin")
    for patch, color in zip(patches, ("blue", "orange", "green", "violet")):
        hull = convex_hull([p for k in patch for p in sides[k]])
        if len(hull) > 2:
            d.polygon(view.all(hull), color, tint=color, width="thin", dash=True)
        for k in patch:
            d.line(*view.all(sides[k]), color, width="bold")
    d.lines(450, 326, ["They cover the surface and stay", "inside. The middle is left open."],
            anchor="middle", color="muted", size="small")


def draw():
    d = Drawing(362, "A patch whose hull leaves the solid, and the hulls of all patches inside a solid")
    polygon = solid()
    patches = decompose(polygon)
    assert sorted(k for patch in patches for k in patch) == list(range(len(polygon)))
    draw_refusal(d, polygon)
    draw_pieces(d, polygon, patches)
    return d
