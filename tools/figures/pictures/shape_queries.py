"""How a ray, a ball, a box and a point are tested against triangles (docs/shape-queries.md)."""
import math

from drawing import Drawing, View
from geometry import add, contains, cross, dot, edges, lerp, mul, nearest_on_segment, sub, unit


def signs_around(triangle, p):
    """The sides on which a ray, seen along itself as the point p, passes the edges."""
    return [1 if cross(sub(b, a), sub(p, a)) > 0 else -1 for a, b in edges(triangle)]


def draw_ray(d):
    d.text(150, 20, "Ray: signs of three edges", anchor="middle", size="head")
    view = View((138, 112), 66)
    p = (-0.32, 0.1)
    left, right = [(-1.5, -0.7), (0.35, -0.95), (0.1, 1.0)], [(0.35, -0.95), (1.75, 0.3), (0.1, 1.0)]
    for triangle, color in ((left, "blue"), (right, "orange")):
        d.polygon(view.all(triangle), color, tint=color)
        middle = mul(1 / 3, add(add(*triangle[:2]), triangle[2]))
        for (a, b), sign in zip(edges(triangle), signs_around(triangle, p)):
            at = lerp(lerp(a, b, 0.5), middle, 0.26)
            x, y = view(at)
            d.line((x - 6, y), (x + 6, y), color, width="bold")
            if sign > 0:
                d.line((x, y - 6), (x, y + 6), color, width="bold")
    assert len(set(signs_around(left, p))) == 1 and len(set(signs_around(right, p))) == 2
    x, y = view(p)
    d.circle((x, y), 7, "green", width="bold")
    d.dot((x, y), "green", 2.5)
    d.lines(150, 204, ["Three equal signs are a hit.", "The shared edge has opposite signs:",
                       "no ray slips between."], anchor="middle", color="muted", size="small")


def draw_ball(d):
    d.text(450, 20, "Ball: two certificates", anchor="middle", size="head")
    view = View((450, 92), 60)
    low, high = (-1.5, -1.15), (1.55, -0.75)
    center, radius = (-0.1, 0.0), 0.98
    foot = nearest_on_segment(center, low, high)
    off = lerp(low, high, 0.37)  # the point that was found, drawn much too far from the true one
    n = unit(sub(center, off))
    d.circle(view(center), 60 * radius, "orange", tint="orange")
    d.line(view(low), view(high), "blue", width="bold")
    d.dot(view(center), "orange")
    d.line(view(center), view(off), "green")
    d.dot(view(off), "green")
    level = max(dot(n, low), dot(n, high))
    across = (n[1], -n[0])
    at = add(center, mul(level - dot(n, center), n))
    d.line(view(add(at, mul(-1.45, across))), view(add(at, mul(1.5, across))), "violet", dash=True)
    upper, lower = math.dist(center, off), dot(n, center) - level
    assert lower < math.dist(center, foot) < upper
    d.lines(450, 204, ["A point (green) bounds the distance", "from above, a plane from below.",
                       "Exact products decide between."], anchor="middle", color="muted", size="small")


def draw_box(d):
    d.text(150, 284, "Box: supporting planes", anchor="middle", size="head")
    view = View((150, 374), 62)
    box = [(-1.3, -0.75), (-0.1, -0.75), (-0.1, 0.35), (-1.3, 0.35)]
    triangle = [(-0.35, 1.1), (0.75, -0.6), (1.6, 0.75)]
    d.polygon(view.all(box), "orange", tint="orange")
    d.polygon(view.all(triangle), "blue", tint="blue")
    parting = []
    for k, (p, q) in enumerate(edges(triangle)):
        third = triangle[(k + 2) % 3]
        side = cross(sub(q, p), sub(third, p))
        if all(cross(sub(q, p), sub(r, p)) * side < 0 for r in box):
            parting.append((p, q))
    assert len(parting) == 1
    (p, q), = parting
    d.line(view(lerp(p, q, -0.08)), view(lerp(p, q, 1.12)), "green", width="bold")
    d.lines(150, 450, ["An edge with the triangle on one", "side and the box on the other:",
                       "signs prove them apart."], anchor="middle", color="muted", size="small")


def draw_point(d):
    d.text(450, 284, "Point: parity of crossings", anchor="middle", size="head")
    view = View((440, 366), 62)
    outer = [(1.5 * math.cos(a), 1.0 * math.sin(a)) for a in (0.3, 0.95, 1.8, 2.7, 3.5, 4.4, 5.3, 5.9)]
    cavity = [(0.25 + 0.75 * math.cos(a), 0.05 + 0.5 * math.sin(a)) for a in (0.6, 1.9, 3.3, 4.6, 5.6)]
    d.polygon(view.all(outer), "blue")
    d.polygon(view.all(cavity), "blue")
    d.path("".join("M" + " ".join(f"{x:.2f},{y:.2f}" for x, y in view.all(shape)) + "Z"
                   for shape in (outer, cavity[::-1])), None, tint="blue")
    way = unit((1, 0.16))
    for point, reach in (((-1.05, 0.0), 2.75), ((0.1, -0.22), 1.8)):
        hits = []
        for shape in (outer, cavity):
            for a, b in edges(shape):
                h, k = cross(way, sub(a, point)), cross(way, sub(b, point))
                if h * k < 0:
                    at = lerp(a, b, h / (h - k))
                    if dot(way, sub(at, point)) > 0:
                        hits.append(at)
        inside = contains(outer, point) and not contains(cavity, point)
        assert (len(hits) % 2 == 1) == inside
        color = "green" if inside else "orange"
        d.arrow(view(point), view(add(point, mul(reach, way))), color)
        d.dot(view(point), color, 5)
        for at in hits:
            d.dot(view(at), color, 4)
        end = view(add(point, mul(reach + 0.05, way)))
        d.text(end[0] + 4, end[1] + 5, str(len(hits)), color, bold=True)
    d.lines(450, 450, ["An odd number is inside (green),", "an even one outside, as in",
                       "this cavity (orange)."], anchor="middle", color="muted", size="small")


def draw():
    d = Drawing(500, "How a ray, a ball, a box and a point are tested")
    draw_ray(d)
    draw_ball(d)
    draw_box(d)
    draw_point(d)
    return d
