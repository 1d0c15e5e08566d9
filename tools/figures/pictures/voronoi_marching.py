"""A walk over the features of two convex polygons (docs/convex.md).

The steps are those of src/convex/search/voronoi_marching.cpp in the plane: two features are
measured; if a neighbour lies farther along the gap than the feature, the feature grows towards it;
if the closest point is an end of an edge, the edge shrinks to that vertex.
"""
import math

from drawing import Drawing, View
from geometry import (add, closest_points, contains, convex_hull, dot, edges, left_of, lerp, mul,
                      nearest_on_segment, sub, turned, unit)

A = convex_hull([turned((1.55 * math.cos(t), 1.2 * math.sin(t)), 0.3)
                 for t in (0.2, 0.95, 1.7, 2.4, 3.1, 3.9, 4.7, 5.5)])
B = convex_hull([add((3.95, 0.75), turned((1.3 * math.cos(t), 1.05 * math.sin(t)), 0.95))
                 for t in (0.1, 1.0, 1.9, 2.75, 3.6, 4.3, 5.3)])

START_A, START_B = 2, 2
# Where the number of each step stands: along the gap, and aside.
LABELS = [(0.4, 0, 18), (0.82, 0, -6), (0.25, -4, -8), (0.35, 0, -6), (0.5, 0, -6)]


def points_of(polygon, feature):
    return [polygon[v] for v in feature]


def measure(a, b):
    """Closest points of two features, each a vertex or an edge."""
    a, b = (a * 2)[:2], (b * 2)[:2]
    pairs = [(p, nearest_on_segment(p, *b)) for p in a]
    pairs += [(nearest_on_segment(q, *a), q) for q in b]
    return min(pairs, key=lambda pair: math.dist(*pair))


def shrink(polygon, feature, point):
    """The vertex at the point, if there is one."""
    for v in feature:
        if math.dist(polygon[v], point) < 1e-9:
            return (v,)
    return feature


def grow(polygon, feature, point, gap):
    """How far a neighbour of a vertex lies ahead along the gap, and the edge to it."""
    if len(feature) == 2:
        return 0.0, None
    v, n = feature[0], len(polygon)
    excess, w = max((dot(gap, sub(polygon[w], point)), w) for w in ((v + 1) % n, (v - 1) % n))
    return excess, (v, w)


def walk(a, b):
    """Steps from a pair of features to the closest one: (feature a, feature b, p, q)."""
    steps = []
    while True:
        p, q = measure(points_of(A, a), points_of(B, b))
        a, b = shrink(A, a, p), shrink(B, b, q)
        steps.append((a, b, p, q))
        gap = sub(q, p)
        grown_a, grown_b = grow(A, a, p, gap), grow(B, b, q, mul(-1, gap))
        if max(grown_a[0], grown_b[0]) < 1e-9:
            return steps
        if grown_a[0] >= grown_b[0]:
            a = grown_a[1]
        else:
            b = grown_b[1]


def outward(p, q):
    """Normal of an edge of a counter-clockwise polygon."""
    return mul(-1, left_of(unit(sub(q, p))))


def region(polygon, feature, reach):
    """The part of a feature's Voronoi region within `reach` of the polygon, as a polygon."""
    n = len(polygon)
    if len(feature) == 2:
        i = next(i for i in feature if (i + 1) % n in feature)
        p, q = polygon[i], polygon[(i + 1) % n]
        away = mul(reach, outward(p, q))
        return [p, q, add(q, away), add(p, away)]
    v = feature[0]
    at = polygon[v]
    first, last = outward(polygon[v - 1], at), outward(at, polygon[(v + 1) % n])
    start, end = (math.atan2(m[1], m[0]) for m in (first, last))
    end += 2 * math.pi if end < start else 0
    angles = [start + (end - start) * i / 12 for i in range(13)]
    return [at] + [add(at, (reach * math.cos(t), reach * math.sin(t))) for t in angles]


def draw():
    d = Drawing(368, "Features of two convex polygons walk to the closest pair")
    view = View((162, 176), 74)
    steps = walk((START_A,), (START_B,))
    last_a, last_b, p, q = steps[-1]
    assert abs(math.dist(p, q) - math.dist(*closest_points(A, B))) < 1e-12
    assert contains(region(A, last_a, 2), q) and contains(region(B, last_b, 2), p)
    reach = 0.98 * math.dist(p, q)
    for polygon, feature, color in ((A, last_a, "blue"), (B, last_b, "orange")):
        d.polygon(view.all(region(polygon, feature, reach)), None, tint=color)
        for (start, end) in edges(polygon):
            away = mul(0.5, outward(start, end))
            for at in (start, end):
                d.line(view(at), view(add(at, away)), "faint", width="line")
        d.polygon(view.all(polygon), color, tint=color)
    for k, (a, b, p, q) in enumerate(steps):
        final = k + 1 == len(steps)
        d.line(view(p), view(q), "green" if final else "muted", width="bold" if final else "line",
               dash=not final)
        for polygon, feature, at in ((A, a, p), (B, b, q)):
            if final and len(feature) == 2:
                d.line(*view.all(points_of(polygon, feature)), "green", width="bold")
            d.dot(view(at), "green" if final else "muted", 5 if final else 4)
        x, y = view(lerp(p, q, LABELS[k][0]))
        d.text(x + LABELS[k][1], y + LABELS[k][2], str(k + 1), "green" if final else "ink",
               anchor="middle", bold=True)
    d.text(*view((-0.2, -0.1)), "A", "blue", bold=True)
    d.text(*view((4.3, 0.9)), "B", "orange", bold=True)
    d.text(300, 316, "1 to 4: the features move to neighbours that lie farther along the gap.",
           anchor="middle", color="muted", size="small")
    d.text(300, 337, "5: each point lies in the Voronoi region (shaded) of the other feature,",
           anchor="middle", color="muted", size="small")
    d.text(300, 358, "so no pair of points is closer.", anchor="middle", color="muted",
           size="small")
    return d
