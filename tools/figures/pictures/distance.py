"""The search for the distance of two curves, and the gaps of two boxes (docs/distance.md).

Curves of 64 segments stand for surfaces. A node has four children, boxed along its own principal
axes, and a leaf has four segments. The search is that of src/tree/traverse_pair.cpp with a heap in
place of buckets: one descent to a pair of leaves, then the nearest pair of boxes first. Bounds are
gaps in the frames of both nodes and, once points have been found, along the direction n.
"""
import heapq
import math

from drawing import Drawing, View
from geometry import add, bounds, closest_points, corners, dot, mul, principal_axes, sub, unit

WIDE, LEAF = 4, 4


def curve(f, low, high):
    return [f(low + (high - low) * i / 64) for i in range(65)]


A = curve(lambda x: (x, -0.3 - 0.06 * x * x + 0.25 * math.sin(6 * x)), -2.9, 2.9)
B = curve(lambda x: (x + 0.3, 0.45 + 0.03 * (x - 0.4) ** 2 + 0.25 * math.cos(5.4 * x + 0.4)), -2.9, 2.7)


class Node:
    """The part of a curve from segment `begin` to `end`; its box is along the axes of the parent."""

    def __init__(self, points, begin, end, axes):
        self.points = points[begin:end + 1]
        box = bounds([(dot(p, axes[0]), dot(p, axes[1])) for p in self.points])
        self.shape = [add(mul(x, axes[0]), mul(y, axes[1])) for x, y in corners(box)]
        self.center = mul(0.25, add(add(*self.shape[:2]), add(*self.shape[2:])))
        self.axes = axes
        middle = mul(1 / len(self.points), (sum(p[0] for p in self.points),
                                            sum(p[1] for p in self.points)))
        off = [sub(p, middle) for p in self.points]
        own = principal_axes(sum(x * x for x, _ in off), sum(x * y for x, y in off),
                             sum(y * y for _, y in off))
        step = (end - begin) // WIDE
        self.children = [] if step == 0 or end - begin == LEAF else [
            Node(points, begin + i * step, begin + (i + 1) * step, own) for i in range(WIDE)]


def gap(a, b, n):
    """The gap of two boxes along n; negative if they overlap there."""
    u, v = [dot(p, n) for p in a.shape], [dot(p, n) for p in b.shape]
    return max(min(v) - max(u), min(u) - max(v))


def bound_along(axes, a, b):
    return math.hypot(*(max(0.0, gap(a, b, axis)) for axis in axes))


def bound(a, b, n):
    return max(bound_along(a.axes, a, b), bound_along(b.axes, a, b), gap(a, b, n))


def measure(a, b):
    """The closest points of two leaves, by their segments."""
    pairs = [closest_points([p, q], [r, s]) for p, q in zip(a.points, a.points[1:])
             for r, s in zip(b.points, b.points[1:])]
    return min(pairs, key=lambda pair: math.dist(*pair))


def search(a, b):
    """The best distance and the least bound that is left, after each step, and the closest points."""
    p, q = a, b
    while p.children:
        p, q = min(((c, e) for c in p.children for e in q.children),
                   key=lambda pair: math.dist(pair[0].center, pair[1].center))
    ends = measure(p, q)
    best, steps, heap, count = math.dist(*ends), [], [(0.0, 0, a, b)], 1
    while heap and heap[0][0] < best:
        low, _, p, q = heapq.heappop(heap)
        steps.append((best, low))
        if not p.children:
            found = measure(p, q)
            if math.dist(*found) < best:
                ends, best = found, math.dist(*found)
            continue
        n = unit(sub(ends[1], ends[0]))
        for c in p.children:
            for e in q.children:
                near = max(low, bound(c, e, n))
                if near < best:
                    heapq.heappush(heap, (near, count, c, e))
                    count += 1
    return steps + [(best, best)], ends


def draw_curves(d, a, b, ends):
    view = View((300, 108), 88)
    for node, color in ((a, "blue"), (b, "orange")):
        for child in node.children:
            d.polygon(view.all(child.shape), color, width="thin", tint=color)
        d.polyline(view.all(node.points), color)
    d.line(*view.all(ends), "green", width="bold")
    for p in ends:
        d.dot(view(p), "green")
    d.text(24, 190, "a", "blue", bold=True)
    d.text(24, 62, "b", "orange", bold=True)


def draw_steps(d, steps):
    d.text(150, 246, "Bounds in each step", anchor="middle", size="head")
    left, base, wide, tall = 30, 418, 250, 136
    top = 1.12 * steps[0][0]

    def at(step, value):
        return left + wide * step / (len(steps) - 1), base - tall * value / top

    d.arrow((left, base), (left, base - tall - 14), "muted")
    d.line((left, base), (left + wide, base), "muted")
    for which, color in ((0, "green"), (1, "violet")):
        points = [at(0, steps[0][which])]
        for k in range(1, len(steps)):
            points += [at(k, steps[k - 1][which]), at(k, steps[k][which])]
        d.polyline(points, color, width="bold")
    d.text(at(5, 0)[0], at(0, steps[0][0])[1] - 9, "nearest triangles so far", "green", size="small")
    d.text(at(4, 0)[0], at(0, 0.2 * top)[1], "nearest boxes left", "violet", size="small")
    d.text(left + wide, base + 20, f"{len(steps) - 1} steps", "muted", anchor="end", size="small")


class Box:
    """A box with its own axes, as a Node has."""

    def __init__(self, corner, angle, low, high):
        self.axes = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
        self.shape = [add(corner, add(mul(x, self.axes[0]), mul(y, self.axes[1])))
                      for x, y in corners((low, high))]


def draw_gaps(d):
    d.text(448, 246, "Gaps of two boxes", anchor="middle", size="head")
    view = View((386, 346), 76)
    p = Box((0, -0.25), math.radians(45), (-0.62, -0.62), (0, 0))
    q = Box((0, 0.25), math.radians(25), (0, 0), (0.75, 0.5))
    n = (0, 1)
    d.polygon(view.all(p.shape), "blue", tint="blue")
    d.polygon(view.all(q.shape), "orange", tint="orange")
    d.text(*view((0, -0.75)), "p", "blue", anchor="middle", bold=True)
    d.text(*view((0.22, 0.62)), "q", "orange", anchor="middle", bold=True)
    d.arrow(view((0, -0.25)), view((0, 0.25)), "green")
    d.text(*view((-0.1, -0.06)), "n", "green", anchor="end", bold=True)
    rows = (("in p's frame", bound_along(p.axes, p, q), "blue"),
            ("in q's frame", bound_along(q.axes, p, q), "orange"), ("along n", gap(p, q, n), "green"))
    best = 0.48
    assert rows[0][1] < best and rows[1][1] < best < rows[2][1]
    for row, (name, value, color) in enumerate(rows):
        y = 290 + 48 * row
        d.text(474, y, name, color, size="small")
        d.rect(474, y + 7, 200 * value, 12, color, tint=color)
    d.line((474 + 200 * best, 276), (474 + 200 * best, 414), "ink", width="thin", dash=True)
    d.text(590, 432, "distance so far", "ink", anchor="end", size="small")


def draw():
    d = Drawing(446, "The search for the distance of two curves, and three bounds for two boxes")
    a, b = (Node(points, 0, 64, ((1, 0), (0, 1))) for points in (A, B))
    steps, ends = search(a, b)
    draw_curves(d, a, b, ends)
    draw_steps(d, steps)
    draw_gaps(d)
    return d
