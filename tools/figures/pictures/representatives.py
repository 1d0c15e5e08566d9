"""Features given to triangles, and the tests that two triangles keep.

See docs/representative-triangles.md. The assignment is `greedy`: a feature goes to the
first triangle that has it.
"""
from drawing import Drawing
from geometry import Random, add, lerp, mul

SIDE = 4  # vertices along a side of a patch
PICKED_A, PICKED_B = 8, 9  # the two triangles whose tests are listed


def patch(origin, seed):
    """Vertices and triangles of a bent grid, row by row."""
    shift = Random(seed)
    points = [(origin[0] + 74 * x + shift(-9, 9), origin[1] + 62 * y + shift(-8, 8))
              for y in range(SIDE) for x in range(SIDE)]
    triangles = []
    for y in range(SIDE - 1):
        for x in range(SIDE - 1):
            v = SIDE * y + x
            triangles += [(v, v + SIDE, v + SIDE + 1), (v, v + SIDE + 1, v + 1)]
    return points, triangles


def greedy(triangles):
    """The vertices and the edges that each triangle represents."""
    taken, result = set(), []
    for t in triangles:
        features = [(v,) for v in t] + [tuple(sorted((t[k], t[(k + 1) % 3]))) for k in range(3)]
        mine = [f for f in features if f not in taken]
        taken.update(mine)
        result.append(mine)
    return result


def inset(points, triangle, share):
    middle = mul(1 / 3, add(add(points[triangle[0]], points[triangle[1]]), points[triangle[2]]))
    return {v: lerp(points[v], middle, share) for v in triangle}


def draw_patch(d, surface, picked, color, name):
    points, triangles = surface
    owned = greedy(triangles)
    for k, t in enumerate(triangles):
        d.polygon([points[v] for v in t], "faint", tint=color if k == picked else None)
    for k, t in enumerate(triangles):
        at = inset(points, t, 0.24)
        shade = color if k == picked else "muted"
        for feature in owned[k]:
            if len(feature) == 1:
                d.dot(at[feature[0]], shade, 5 if k == picked else 4)
            else:
                p, q = at[feature[0]], at[feature[1]]
                d.line(lerp(p, q, 0.2), lerp(p, q, 0.8), shade,
                       width="bold" if k == picked else "line")
    middle = inset(points, triangles[picked], 1)[triangles[picked][0]]
    d.text(middle[0], middle[1] + 6, name, color, anchor="middle", bold=True)
    return triangles[picked], owned[picked]


def draw():
    d = Drawing(446, "Each feature is represented by one triangle; two triangles keep few tests")
    d.text(300, 20, "A dot or stroke lies in the triangle that represents the feature.",
           anchor="middle", color="muted", size="small")
    a, own_a = draw_patch(d, patch((22, 52), 5), PICKED_A, "blue", "A")
    b, own_b = draw_patch(d, patch((356, 52), 11), PICKED_B, "orange", "B")

    def vertices(t):
        return [(v,) for v in t]

    def sides(t):
        return [tuple(sorted((t[k], t[(k + 1) % 3]))) for k in range(3)]

    face = ("face",)
    grids = [("vertex of A,", "face of B", vertices(a), [face]),
             ("face of A,", "vertex of B", [face], vertices(b)),
             ("edge of A,", "edge of B", sides(a), sides(b))]
    cell, kept, total = 30, 0, 0
    left = [70, 190, 345]
    for x, (first, second, rows, columns) in zip(left, grids):
        wide = cell * len(columns)
        top = 352 - cell * len(rows) / 2
        for i, row in enumerate(rows):
            for k, column in enumerate(columns):
                keep = all(f == face or f in own
                           for f, own in ((row, own_a), (column, own_b)))
                kept, total = kept + keep, total + 1
                cx, cy = x + cell * k, top + cell * i
                d.rect(cx, cy, cell, cell, "muted", width="thin", tint="green" if keep else None)
                if keep:
                    d.polyline([(cx + 8, cy + 16), (cx + 13, cy + 21), (cx + 22, cy + 9)], "green",
                               width="bold")
        d.text(x + wide / 2, 284, first, anchor="middle", size="small")
        d.text(x + wide / 2, 301, second, anchor="middle", size="small")
    assert total == 15
    d.text(530, 344, f"{total} tests", anchor="middle")
    d.arrow((530, 352), (530, 378))
    d.text(530, 398, f"{kept} tests", "green", anchor="middle", bold=True)
    d.text(300, 434, "A pair keeps the tests whose features its triangles represent.",
           anchor="middle", color="muted", size="small")
    return d
