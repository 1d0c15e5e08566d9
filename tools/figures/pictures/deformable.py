"""The impacts of a fold during one step, and the two kinds of impacts (docs/deformable.md).

The fold is a curve in the plane: a vertex meets a segment when three points lie on a line, a
quadratic in time. Vertex and face, and edge and edge, are in space: their four vertices lie in a
plane at a root of a cubic.
"""
import math

from drawing import Drawing, View
from geometry import cross, dot, lerp, sub


def fold(t):
    """A loop of cloth, whose upper part falls through the lower one while t goes from 0 to 1."""
    start = [(-2.6, 0.15), (-1.9, 0.0), (-1.2, 0.05), (-0.5, -0.05), (0.2, 0.0), (0.85, 0.1),
             (1.3, 0.5), (1.25, 1.1), (0.75, 1.4), (0.35, 1.2), (-0.15, 0.95), (-0.85, 1.05),
             (-1.6, 1.3)]
    end = [(-2.6, 0.1), (-1.9, 0.05), (-1.2, 0.12), (-0.5, 0.1), (0.2, 0.0), (0.9, -0.1),
           (1.45, 0.25), (1.45, 0.85), (0.9, 1.1), (0.38, 0.62), (-0.1, -0.28), (-0.85, -0.42),
           (-1.6, 0.42)]
    return [lerp(p, q, t) for p, q in zip(start, end)]


def meeting_time(v, a, b):
    """The first time at which vertex v lies on segment a b, or None."""
    samples = 4000

    def side(t):
        p = fold(t)
        return cross(sub(p[b], p[a]), sub(p[v], p[a]))

    for k in range(samples):
        low, high = k / samples, (k + 1) / samples
        if side(low) * side(high) > 0:
            continue
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if side(low) * side(middle) > 0 else (low, middle)
        p = fold(low)
        u = dot(sub(p[v], p[a]), sub(p[b], p[a])) / dot(sub(p[b], p[a]), sub(p[b], p[a]))
        if 0 <= u <= 1:
            return low
    return None


def impacts():
    count = len(fold(0))
    found = [(meeting_time(v, a, a + 1), v) for v in range(count) for a in range(count - 1)
             if v not in (a, a + 1)]
    return sorted((t, v) for t, v in found if t is not None)


def lerp3(p, q, t):
    return tuple(a + t * (b - a) for a, b in zip(p, q))


def coplanarity(a, b, c, e):
    u, v, w = (tuple(x - y for x, y in zip(p, a)) for p in (b, c, e))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0]))


def root(start, end):
    low, high = 0.0, 1.0

    def f(t):
        return coplanarity(*(lerp3(p, q, t) for p, q in zip(start, end)))

    assert f(0) * f(1) < 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if f(low) * f(middle) > 0 else (low, middle)
    return low


def draw_fold(d):
    d.text(300, 20, "One step: all impacts, each once", anchor="middle", size="head")
    view = View((300, 178), 96)
    found = impacts()
    for p, q in zip(fold(0), fold(1)):
        if math.dist(p, q) > 0.02:
            d.line(view(p), view(q), "faint", width="thin", dash=True)
    d.polyline(view.all(fold(0)), "blue")
    d.polyline(view.all(fold(1)), "orange")
    for p, q in zip(fold(0), fold(1)):
        d.dot(view(p), "blue", 2.5)
        d.dot(view(q), "orange", 2.5)
    at = sorted((fold(t)[v][0], fold(t)[v][1], t) for t, v in found)
    for k, (x, y, t) in enumerate(at):
        label = (x + 0.62 * (k - 1.5), -0.85)
        d.line(view((x, y - 0.04)), view((label[0], label[1] + 0.22)), "green", width="thin")
        d.dot(view((x, y)), "green", 5)
        d.text(*view(label), f"t = {t:.2f}", "green", anchor="middle", size="small", bold=True)
    d.text(*view((1.36, 1.3)), "t = 0", "blue", bold=True)
    d.text(*view((1.55, 0.6)), "t = 1", "orange", bold=True)


def draw_kind(d, middle, name, first, second):
    """Two features in space at t = 0, and where they meet. `first` moves, `second` rests."""
    def flat(p):
        return (middle + 78 * (p[0] + 0.4 * p[1]), 370 - 78 * (0.4 * p[1] + 0.9 * p[2]))

    start, end = first
    t = root(start + second, end + second)
    d.text(middle, 288, name, anchor="middle", size="head")
    shape = [flat(p) for p in second]
    if len(shape) == 3:
        d.polygon(shape, "orange", tint="orange")
    else:
        d.line(*shape, "orange", width="bold")
    now = [lerp3(p, q, t) for p, q in zip(start, end)]
    for p, q in zip(start, end):
        d.arrow(flat(p), flat(q), "faint")
    for moment, style in ((start, {"width": "bold"}), (now, {"dash": True})):
        if len(moment) == 2:
            d.line(flat(moment[0]), flat(moment[1]), "blue", **style)
    if len(start) == 1:
        d.dot(flat(start[0]), "blue", 5)
        place = now[0]
    else:
        place = crossing(now, second)
    d.dot(flat(place), "green", 5)
    x, y = flat(place)
    d.text(x - 4, y + 40, f"t = {t:.2f}", "green", anchor="end", size="small", bold=True)


def crossing(edge, other):
    """Where two edges of one plane meet, seen from above."""
    a, b = [(p[0], p[1]) for p in edge]
    c, e = [(p[0], p[1]) for p in other]
    u = cross(sub(c, a), sub(e, c)) / cross(sub(b, a), sub(e, c))
    return lerp3(edge[0], edge[1], u)


def draw():
    d = Drawing(452, "The impacts of a fold during one step, and the two kinds of impacts")
    draw_fold(d)
    face = [(-1.2, -0.8, 0.0), (1.1, -0.5, 0.1), (-0.1, 1.1, -0.1)]
    draw_kind(d, 150, "Vertex and face", ([(-0.3, -0.3, 0.8)], [(0.15, 0.05, -0.65)]), face)
    edges = [(-1.1, -0.5, 0.0), (1.1, 0.4, 0.15)]
    draw_kind(d, 440, "Edge and edge", ([(-1.0, 0.9, 0.55), (0.9, -0.8, 0.95)],
                                        [(-0.8, 1.0, -0.6), (1.0, -0.7, -0.4)]), edges)
    return d
