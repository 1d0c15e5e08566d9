"""Regions, normals and points of a contact of two models (docs/model-contacts.md).

A bench with two feet sinks into a floor. In space: the closed curves in which the surfaces cross,
and the normal of each, half the sum of p x q over its segments. In section: the depth along the
normal beside the distance to the nearest surface, and a region that bends around a hollow.
"""
import math

from drawing import Drawing, View
from geometry import add, contains, mul, nearest_on_boundary, sub, turned


def leg_at(x, low, high):
    """A leg as two rings of corners."""
    return [[(x + 0.34 * sx, 0.4 * sy, z) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            for z in (low, high)]


def lerp3(p, q, t):
    return tuple(a + t * (b - a) for a, b in zip(p, q))


def floor_at(x):
    """The floor, that falls away to the right."""
    return -0.12 * x


def crossing_curve(leg):
    """Where the leg's four edges and sides pass through the floor: the corners of the curve."""
    found = []
    for p, q in zip(*leg):
        h, k = p[2] - floor_at(p[0]), q[2] - floor_at(q[0])
        assert h < 0 < k
        found.append(lerp3(p, q, h / (h - k)))
    return found


def vector_area(curve):
    center = tuple(sum(p[i] for p in curve) / len(curve) for i in range(3))
    total = [0.0, 0.0, 0.0]
    for p, q in zip(curve, curve[1:] + curve[:1]):
        u, v = [a - c for a, c in zip(p, center)], [a - c for a, c in zip(q, center)]
        for i in range(3):
            total[i] += 0.5 * (u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3])
    size = math.sqrt(sum(x * x for x in total))
    return center, [x / size for x in total]


def flat(p):
    return (300 + 96 * (p[0] + 0.45 * p[1]), 128 - 96 * (0.38 * p[1] + 0.86 * p[2]))


def draw_space(d):
    d.text(300, 20, "Two regions, each with a normal and up to four points", anchor="middle",
           size="head")
    corners = [(-2.1, -0.75), (2.1, -0.75), (2.1, 0.75), (-2.1, 0.75)]
    d.polygon([flat((x, y, floor_at(x))) for x, y in corners], "orange", tint="orange")
    seat = [(-1.6, -0.42), (1.6, -0.42), (1.6, 0.42), (-1.6, 0.42)]
    legs = [leg_at(-1.15, -0.12, 0.75), leg_at(1.15, -0.42, 0.75)]
    for leg in legs:
        low, high = leg
        curve = crossing_curve(leg)
        for k in range(4):
            d.line(flat(curve[k]), flat(high[k]), "blue", width="thin")
            d.line(flat(low[k]), flat(curve[k]), "blue", width="thin", dash=True)
            d.line(flat(low[k]), flat(low[(k + 1) % 4]), "blue", width="thin", dash=True)
        d.polygon([flat(p) for p in curve], "green", width="bold", tint="green")
        for p in low:
            d.dot(flat(p), "blue", 4)
        center, n = vector_area(curve)
        d.arrow(flat(center), flat(lerp3(center, [c + x for c, x in zip(center, n)], 0.62)), "green")
    d.polygon([flat((x, y, 0.75)) for x, y in seat], "blue", tint="blue")


def draw_depth(d):
    """The deepest vertex of b: its depth along the normal, and the nearest point of a.

    The curve's own normal leans by 22 degrees; half of the curve is on the upper face, whose normal
    takes its place.
    """
    d.text(150, 248, "The depth is along the normal", anchor="middle", size="head")
    view = View((150, 350), 66)
    a = [(-1.7, -0.95), (0.45, -0.95), (0.45, 0.0), (-1.7, 0.0)]
    b = [add((0.16, -0.46), turned(p, 0.62)) for p in ((0, 0), (1.5, 0), (1.5, 0.62), (0, 0.62))]
    d.polygon(view.all(a), "orange", tint="orange")
    d.polygon(view.all(b), "blue", tint="blue")
    deepest = min(b, key=lambda p: p[1])
    assert contains(a, deepest)
    above, nearest = (deepest[0], 0.0), nearest_on_boundary(deepest, a)
    assert math.dist(deepest, nearest) < math.dist(deepest, above)
    d.arrow(view(deepest), view(above), "green")
    d.line(view(deepest), view(nearest), "violet", dash=True)
    d.dot(view(deepest), "blue")
    d.text(*view((-0.14, -0.34)), "depth", "green", anchor="end", size="small")
    d.line(view((0.3, -0.48)), view((0.62, -0.72)), "violet", width="thin")
    d.text(*view((0.66, -0.84)), "nearest", "violet", size="small")
    d.text(*view((-1.6, -0.82)), "a", "orange", bold=True)
    d.text(*view((0.55, 0.3)), "b", "blue", bold=True)


def draw_corner(d):
    """A ball in the corner of a room: the direction of the faces splits the region."""
    d.text(450, 248, "A hollow is split", anchor="middle", size="head")
    view = View((410, 378), 70)
    room = [(-0.35, -0.35), (2.2, -0.35), (2.2, 0.0), (0.0, 0.0), (0.0, 1.55), (-0.35, 1.55)]
    center, radius = (0.62, 0.66), 0.78
    d.polygon(view.all(room), "orange", tint="orange")
    d.circle(view(center), 70 * radius, "blue", tint="blue")
    for axis, n in ((1, (0.0, 1.0)), (0, (1.0, 0.0))):
        deepest = sub(center, mul(radius, n))
        surface = tuple(0.0 if i == axis else deepest[i] for i in (0, 1))
        half = math.sqrt(radius**2 - center[axis]**2)
        along = (n[1], n[0])
        ends = [add(surface, mul(s * half, along)) for s in (-1, 1)]
        d.line(*view.all(ends), "green", width="bold")
        d.arrow(view(surface), view(add(surface, mul(0.55, n))), "green")
        d.dot(view(deepest), "blue")
    x, y = view((1.55, 0.75))
    d.lines(x, y, ["two", "normals"], color="green", size="small")


def draw():
    d = Drawing(424, "Two regions of a contact, a depth along the normal, and a region that is split")
    draw_space(d)
    draw_depth(d)
    draw_corner(d)
    return d
