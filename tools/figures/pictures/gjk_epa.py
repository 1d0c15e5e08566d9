"""GJK and EPA on the difference of two polygons (docs/convex.md).

The difference B - A is the hull of all differences of vertices. GJK moves a simplex of its corners
towards the origin, as src/convex/search/gjk.cpp does in space; EPA grows a polygon inside it where
its boundary is nearest to the origin, as epa.cpp does.
"""
import math

from drawing import Drawing, View
from geometry import (add, closest_points, convex_hull, cross, dot, edges, left_of, mul,
                      nearest_on_segment, sub, support, turned, unit)

A = convex_hull([(0.92 * math.cos(t), 0.78 * math.sin(t)) for t in (0.2, 1.3, 2.5, 3.6, 5.1)])
B = convex_hull([turned((0.95 * math.cos(t), 0.6 * math.sin(t)), 0.5)
                 for t in (0.0, 1.1, 2.2, 3.3, 4.2, 5.3)])
APART, MEETING = (1.3, 1.5), (0.8, -0.2)  # where B stands
GJK_LABELS = [(8, 5), (-2, -8), (10, 0), (9, 8)]  # aside of each number
EPA_LABELS = [(-4, -7), (6, 19), (-10, 4)]


def difference(b):
    return convex_hull([sub(q, p) for p in A for q in b])


def nearest_of(simplex):
    """The point of a simplex that is nearest to the origin, and the corners that hold it."""
    if len(simplex) == 1:
        return simplex[0], simplex
    if len(simplex) == 3:
        p, q, r = simplex
        turns = [cross(p, q), cross(q, r), cross(r, p)]
        if min(turns) >= 0 or max(turns) <= 0:
            return (0.0, 0.0), simplex
    pairs = [(simplex[i], simplex[k]) for i in range(len(simplex)) for k in range(i)]
    p, q = min(pairs, key=lambda s: math.hypot(*nearest_on_segment((0, 0), *s)))
    at = nearest_on_segment((0, 0), p, q)
    return at, [c for c in (p, q) if c == at] or [p, q]


def gjk(corners, start):
    """Steps: (simplex, its nearest point)."""
    steps, simplex = [], [start]
    while True:
        at, simplex = nearest_of(simplex)
        steps.append((simplex, at))
        if at == (0.0, 0.0):
            return steps
        corner = corners[support(corners, mul(-1, at))]
        if dot(at, sub(at, corner)) < 1e-12:
            return steps
        simplex = simplex + [corner]


def epa(corners, simplex):
    """The polygons that are grown, and the nearest point of the last one's boundary."""
    polygon = convex_hull(simplex)
    grown = [polygon]
    while True:
        p, q = min(edges(polygon), key=lambda e: math.hypot(*nearest_on_segment((0, 0), *e)))
        normal = mul(-1, left_of(unit(sub(q, p))))
        corner = corners[support(corners, normal)]
        if dot(normal, sub(corner, p)) < 1e-12:
            return grown, nearest_on_segment((0, 0), p, q)
        polygon = convex_hull(polygon + [corner])
        grown.append(polygon)


def draw_bodies(d, view, b):
    d.polygon(view.all(A), "blue", tint="blue")
    d.polygon(view.all(b), "orange", tint="orange")
    d.text(*view((-0.45, -0.1)), "A", "blue", bold=True)
    x, y = view(mul(1 / len(b), (sum(v[0] for v in b), sum(v[1] for v in b))))
    d.text(x + 4, y - 2, "B", "orange", bold=True)


def draw_apart(d):
    """GJK: the nearest points of ever nearer simplices."""
    b = [add(APART, p) for p in B]
    d.text(150, 20, "Apart: GJK", anchor="middle", size="head")
    view = View((112, 146), 44)
    draw_bodies(d, view, b)
    d.line(*view.all(closest_points(A, b)), "green", width="bold")
    corners = difference(b)
    steps = gjk(corners, corners[support(corners, (1, -0.3))])
    view = View((62, 424), 68)
    d.polygon(view.all(corners), "faint", tint="ink")
    for k, (simplex, at) in enumerate(steps):
        last = k + 1 == len(steps)
        color = "green" if last else "violet"
        if len(simplex) == 2:
            d.line(*view.all(simplex), color, width="bold" if last else "line")
        d.dot(view(at), color)
        x, y = view(at)
        d.text(x + GJK_LABELS[k][0], y + GJK_LABELS[k][1], str(k + 1), color, bold=True)
    d.line(view((0, 0)), view(steps[-1][1]), "green", width="bold")
    d.dot(view((0, 0)))
    d.text(*view((0.1, -0.16)), "origin", size="small")
    d.text(*view((1.3, 1.75)), "B − A", "muted", anchor="middle")
    gap, shift = math.dist(*closest_points(A, b)), math.hypot(*steps[-1][1])
    assert abs(gap - shift) < 1e-12


def draw_meeting(d):
    """EPA: polygons inside the difference, grown where their boundary is nearest."""
    b = [add(MEETING, p) for p in B]
    d.text(450, 20, "Meeting: EPA", anchor="middle", size="head")
    corners = difference(b)
    grown, nearest = epa(corners, gjk(corners, corners[support(corners, (-1, -0.8))])[-1][0])
    view = View((424, 112), 52)
    draw_bodies(d, view, b)
    d.polygon(view.all([sub(p, nearest) for p in b]), "orange", width="thin", dash=True)
    from_here = add(MEETING, (0.55, -0.25))
    d.arrow(view(from_here), view(sub(from_here, nearest)), "green")
    view = View((398, 338), 68)
    d.polygon(view.all(corners), "faint", tint="ink")
    for k, polygon in enumerate(grown):
        first = k == 0
        d.polygon(view.all(polygon), "violet", tint="violet" if first else None,
                  width="line" if k + 1 < len(grown) else "bold")
    for k in range(1, len(grown)):
        new = next(p for p in grown[k] if p not in grown[k - 1])
        x, y = view(new)
        d.text(x + EPA_LABELS[k - 1][0], y + EPA_LABELS[k - 1][1], str(k), "violet",
               anchor="middle", bold=True)
    d.line(view((0, 0)), view(nearest), "green", width="bold")
    d.dot(view((0, 0)))
    d.text(*view((0.1, -0.12)), "origin", size="small")
    d.text(*view((2.25, -1.25)), "B \u2212 A", "muted", anchor="middle")


def draw():
    d = Drawing(518, "GJK and EPA on the difference of two convex polygons")
    draw_apart(d)
    draw_meeting(d)
    d.lines(150, 466, ["1 to 4: the nearest points of", "ever nearer simplices, until no",
                       "corner is nearer."], anchor="middle", color="muted", size="small")
    d.lines(450, 466, ["1 to 3: corners added beyond the", "nearest edge, until its distance",
                       "is the depth."], anchor="middle", color="muted", size="small")
    return d
