"""A node's eight children, boxed along the tree's axes and along the node's (docs/tree.md).

The surface is a flat band of 32 triangles. It is cut and its axes are found as src/tree/build.cpp
and orient.cpp do: cuts at the median along the longest axis of the centres, to a multiple of four;
axes are the eigenvectors of the covariance of the surface.
"""
import math

from drawing import Drawing, View
from geometry import (add, bounds, corners, cross, dot, mul, principal_axes, sub, turned, unit)

CHILDREN, QUADS = 8, 16
TREE_AXES = ((1, 0), (0, 1))


def surface():
    """A curved band of triangles."""
    rim = [[], []]
    for i in range(QUADS + 1):
        x = -2.5 + 5 * i / QUADS
        for side in (0, 1):
            y = 0.62 * side - 0.065 * x * x - 0.05
            rim[side].append(turned((x + 0.06 * x * side, y), math.radians(37)))
    low, high = rim
    return [t for i in range(QUADS) for t in ((low[i], low[i + 1], high[i + 1]),
                                              (low[i], high[i + 1], high[i]))]


def center(triangle):
    return mul(1 / 3, add(add(triangle[0], triangle[1]), triangle[2]))


def cut(triangles):
    """Both halves of a set of triangles."""
    low, high = bounds([center(t) for t in triangles])
    axis = 0 if high[0] - low[0] >= high[1] - low[1] else 1
    order = sorted(triangles, key=lambda t: center(t)[axis])
    half = (len(order) // 2 + 3) // 4 * 4
    return [order[:half], order[half:]]


def perimeter(box):
    return 2 * (box[1][0] - box[0][0] + box[1][1] - box[0][1])


def box_along(points, axes):
    return bounds([(dot(p, axes[0]), dot(p, axes[1])) for p in points])


def children_of(triangles):
    """Cuts the largest part until there are eight."""
    parts = [triangles]
    while len(parts) < CHILDREN:
        k = max((i for i, part in enumerate(parts) if len(part) > 4),
                key=lambda i: perimeter(box_along([p for t in parts[i] for p in t], TREE_AXES)))
        parts[k:k + 1] = cut(parts[k])
    return [[p for t in part for p in t] for part in parts]


def axes_of(triangles):
    total = x = y = xx = xy = yy = 0.0
    for p, q, r in triangles:
        area, c = abs(cross(sub(q, p), sub(r, p))), center((p, q, r))
        total, x, y = total + area, x + area * c[0], y + area * c[1]
        for point, share in ((c, 9 / 12), (p, 1 / 12), (q, 1 / 12), (r, 1 / 12)):
            xx += area * share * point[0] * point[0]
            xy += area * share * point[0] * point[1]
            yy += area * share * point[1] * point[1]
    x, y = x / total, y / total
    return principal_axes(xx / total - x * x, xy / total - x * y, yy / total - y * y)


def apart_along(axes, shape, other):
    a, b = box_along(shape, axes), box_along(other, axes)
    return any(a[1][i] < b[0][i] or b[1][i] < a[0][i] for i in (0, 1))


def draw():
    d = Drawing(420, "A node with eight children, along the tree's axes and along its own")
    triangles = surface()
    children = children_of(triangles)
    own = axes_of(triangles)
    query = [add((0.8, -0.42), turned(p, math.radians(-12)))
             for p in ((-0.62, -0.4), (0.62, -0.4), (0.62, 0.4), (-0.62, 0.4))]
    query_axes = (unit(sub(query[1], query[0])), unit(sub(query[3], query[0])))
    sums = []
    for column, (head, axes, color) in enumerate((("Along the tree's axes", TREE_AXES, "muted"),
                                                  ("Along the node's own axes", own, "blue"))):
        middle = 148 + 304 * column
        view = View((middle, 164), 58)
        d.text(middle, 20, head, anchor="middle", size="head")
        for t in triangles:
            d.polygon(view.all(t), "faint", width="thin", tint="ink")
        boxes = [box_along(child, axes) for child in children]
        sums.append(sum(perimeter(b) for b in boxes))
        for k, box in enumerate(boxes):
            shape = [add(mul(x, axes[0]), mul(y, axes[1])) for x, y in corners(box)]
            meets = not (apart_along(axes, shape, query) or apart_along(query_axes, shape, query))
            d.polygon(view.all(shape), color, width="line")
            x, y = view(mul(0.25, add(add(shape[0], shape[1]), add(shape[2], shape[3]))))
            d.text(x, y + 5, str(k + 1), "orange" if meets else "ink", anchor="middle",
                   size="small", bold=True)
            x = middle - 128 + 32 * k
            d.rect(x, 330, 32, 32, color, tint="orange" if meets else None)
            d.text(x + 16, 351, str(k + 1), "orange" if meets else "muted", anchor="middle",
                   size="small", bold=meets)
        d.polygon(view.all(query), "orange", tint="orange")
        for axis in axes:
            origin = (-1.9, 1.2)
            d.arrow(view(origin), view(add(origin, mul(0.62, axis))), color)
        share = round(100 * sums[-1] / sums[0])
        d.text(middle, 315, f"perimeter of the boxes: {share} %", anchor="middle")
    d.text(300, 390, "One SIMD pass compares a box (orange) with all eight children.",
           anchor="middle", color="muted", size="small")
    d.text(300, 410, "The traversal goes on with those that it may meet.", anchor="middle",
           color="muted", size="small")
    return d
