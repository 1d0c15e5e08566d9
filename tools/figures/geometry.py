"""Plane geometry for the figures. Points are (x, y) pairs; polygons run counter-clockwise."""
import math


def add(p, q):
    return (p[0] + q[0], p[1] + q[1])


def sub(p, q):
    return (p[0] - q[0], p[1] - q[1])


def mul(s, p):
    return (s * p[0], s * p[1])


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1]


def cross(p, q):
    return p[0] * q[1] - p[1] * q[0]


def length(p):
    return math.hypot(p[0], p[1])


def unit(p):
    return mul(1 / length(p), p)


def left_of(p):
    """The vector turned by a quarter to the left."""
    return (-p[1], p[0])


def lerp(p, q, t):
    return (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))


def turned(p, angle, about=(0, 0)):
    c, s = math.cos(angle), math.sin(angle)
    x, y = sub(p, about)
    return add(about, (c * x - s * y, s * x + c * y))


def edges(polygon):
    return [(polygon[i], polygon[(i + 1) % len(polygon)]) for i in range(len(polygon))]


def bounds(points):
    """Lower and upper corner of the box of some points."""
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return (min(xs), min(ys)), (max(xs), max(ys))


def boxes_overlap(a, b):
    return all(a[0][i] <= b[1][i] and b[0][i] <= a[1][i] for i in (0, 1))


def corners(box):
    (x0, y0), (x1, y1) = box
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def convex_hull(points):
    points = sorted(set(points))

    def chain(run):
        hull = []
        for p in run:
            while len(hull) > 1 and cross(sub(hull[-1], hull[-2]), sub(p, hull[-2])) <= 0:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return chain(points) + chain(points[::-1])


def contains(polygon, p):
    """Whether a point lies inside a simple polygon."""
    inside = False
    for (x0, y0), (x1, y1) in edges(polygon):
        if (y0 > p[1]) != (y1 > p[1]) and p[0] < x0 + (p[1] - y0) / (y1 - y0) * (x1 - x0):
            inside = not inside
    return inside


def nearest_on_segment(p, a, b):
    d = sub(b, a)
    along = dot(d, d)
    t = min(1.0, max(0.0, dot(sub(p, a), d) / along)) if along > 0 else 0.0
    return lerp(a, b, t)


def nearest_on_boundary(p, polygon):
    return min((nearest_on_segment(p, a, b) for a, b in edges(polygon)),
               key=lambda q: math.dist(p, q))


def closest_points(a, b):
    """Closest points of the boundaries of two polygons that do not cross."""
    pairs = [(p, nearest_on_boundary(p, b)) for p in a]
    pairs += [(nearest_on_boundary(q, a), q) for q in b]
    return min(pairs, key=lambda pair: math.dist(*pair))


def deepest_point(surface, solid, samples=400):
    """The point of a polygon's boundary that lies deepest inside another, and the nearest point of
    that one's boundary; None if no sample lies inside."""
    points = [lerp(p, q, i / samples) for p, q in edges(surface) for i in range(samples)]
    inside = [(p, nearest_on_boundary(p, solid)) for p in points if contains(solid, p)]
    return max(inside, key=lambda pair: math.dist(*pair), default=None)


def support(points, n):
    """Index of the farthest point along n."""
    return max(range(len(points)), key=lambda i: dot(points[i], n))


def principal_axes(xx, xy, yy):
    """Unit eigenvectors of a symmetric matrix, that of the larger eigenvalue first."""
    angle = 0.5 * math.atan2(2 * xy, xx - yy)
    u = (math.cos(angle), math.sin(angle))
    return u, left_of(u)


class Random:
    """A generator whose numbers are the same everywhere."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self, low=0.0, high=1.0):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return low + (high - low) * (self.state >> 40) / 2**24
