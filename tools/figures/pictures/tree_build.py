"""How a set of triangles is cut: the cost of each cut between 16 bins, and the eight children of the
root (docs/tree-build.md).

The cuts are those of src/tree/build.cpp: the surface-area heuristic for more than 256 triangles, a
median to a multiple of 32 below that; the child of largest area is cut next, and a child of at most
32 stays whole. In the plane, the perimeter takes the place of the area.
"""
import math

from drawing import Drawing, View, pair
from geometry import bounds, corners

BINS, CHILDREN, BOTTOM = 16, 8, 32


def grid(x0, y0, x1, y1, nx, ny):
    """A rectangle of 2 nx ny triangles."""
    def at(i, k):
        return (x0 + (x1 - x0) * i / nx, y0 + (y1 - y0) * k / ny)
    return [t for i in range(nx) for k in range(ny)
            for t in ((at(i, k), at(i + 1, k), at(i + 1, k + 1)),
                      (at(i, k), at(i + 1, k + 1), at(i, k + 1)))]


def wheel(center, radius, rings, sectors):
    def at(i, k):
        angle = 2 * math.pi * k / sectors
        return (center[0] + radius * i / rings * math.cos(angle),
                center[1] + radius * i / rings * math.sin(angle))
    found = [(center, at(1, k), at(1, k + 1)) for k in range(sectors)]
    for i in range(1, rings):
        for k in range(sectors):
            found += [(at(i, k), at(i + 1, k), at(i + 1, k + 1)),
                      (at(i, k), at(i + 1, k + 1), at(i, k + 1))]
    return found


def pump():
    """A finely meshed wheel, a pipe, a flange and a foot."""
    return (wheel((0, 0), 0.8, 6, 24) + grid(0.8, -0.22, 4.3, 0.22, 14, 1)
            + grid(4.3, -0.62, 4.55, 0.62, 2, 8) + grid(-0.6, -1.2, 0.6, -0.95, 6, 1))


def box_of(triangles):
    return bounds([p for t in triangles for p in t])


def center(triangle, axis):
    """Twice the centre of the triangle's box."""
    low, high = bounds(triangle)
    return low[axis] + high[axis]


def perimeter(triangles):
    low, high = box_of(triangles)
    return 2 * (high[0] - low[0] + high[1] - low[1])


def cost(left, right):
    return perimeter(left) * len(left) + perimeter(right) * len(right)


def binned(triangles, axis):
    """The cuts below bins 1 to 15, as (place, left, right); a side may be empty."""
    centers = [center(t, axis) for t in triangles]
    low, extent = min(centers), max(centers) - min(centers)
    scale = 0.9999 * BINS / extent
    number = [min(BINS - 1, int((c - low) * scale)) for c in centers]
    return [((low + k / scale) / 2, [t for t, n in zip(triangles, number) if n < k],
             [t for t, n in zip(triangles, number) if n >= k]) for k in range(1, BINS)]


def halves(triangles, quantum):
    """Cuts at the median of the longest axis of the centres, to a multiple of the quantum."""
    def extent(axis):
        centers = [center(t, axis) for t in triangles]
        return max(centers) - min(centers)
    axis = max((0, 1), key=extent)
    order = sorted(triangles, key=lambda t: center(t, axis))
    cut = (len(order) // quantum + 1) // 2 * quantum
    return order[:cut], order[cut:]


def split(triangles):
    if len(triangles) <= BOTTOM * CHILDREN:
        return halves(triangles, BOTTOM)
    cuts = [(left, right) for axis in (0, 1) for _, left, right in binned(triangles, axis)
            if left and right]
    return min(cuts, key=lambda cut: cost(*cut))


def children_of(triangles):
    """Cuts the child of largest area until there are eight."""
    parts = [triangles]
    while len(parts) < CHILDREN:
        large = [k for k in range(len(parts)) if len(parts[k]) > BOTTOM]
        if not large:
            break
        k = max(large, key=lambda i: perimeter(parts[i]))
        low, high = split(parts[k])
        parts[k] = low
        parts.append(high)
    return parts


def draw_triangles(d, view, triangles):
    d.points += [view(p) for t in triangles for p in t]
    d.path("".join("M" + " ".join(pair(view(p)) for p in t) + "Z" for t in triangles), "faint",
           width="thin")


def draw_cuts(d, view, triangles):
    """The model, the borders between bins on its longest axis, and the cost of a cut at each."""
    draw_triangles(d, view, triangles)
    whole = perimeter(triangles) * len(triangles)
    cuts = binned(triangles, 0)
    costs = [cost(left, right) / whole for _, left, right in cuts]
    least = min(range(len(cuts)), key=lambda k: costs[k])
    assert sorted(map(len, split(triangles))) == sorted(map(len, cuts[least][1:]))
    base, tall = 316, 86
    d.line((20, base), (580, base), "muted", width="thin")
    order = sorted(triangles, key=lambda t: center(t, 0))
    half = len(order) // 2
    median = (center(order[half], 0) / 2, cost(order[:half], order[half:]) / whole, "blue", "median")
    for k, (place, _, _) in enumerate(cuts):
        x = view((place, 0))[0]
        if k != least:
            d.line((x, 34), (x, base - tall * costs[k] - 6), "faint", width="thin", dash=True)
            d.line((x, base), (x, base - tall * costs[k]), "muted", width="bold")
    best = (cuts[least][0], costs[least], "orange", "least")
    for (place, share, color, name), anchor in ((best, "start"), (median, "middle")):
        x = view((place, 0))[0]
        d.line((x, 34), (x, base - tall * share), color)
        d.line((x, base), (x, base - tall * share), color, width="bold")
        y = base + 19 if color == "blue" else base - 72
        d.text(x + (5 if anchor == "start" else 0), y, f"{name} {round(100 * share)} %", color,
               anchor=anchor, bold=True, size="small")
    d.text(580, base + 19, "cost of each cut, as a share of the whole", "muted", anchor="end",
           size="small")


def draw():
    d = Drawing(564, "The cost of the cuts between bins, and the eight children of a node")
    triangles = pump()
    d.text(300, 20, f"{len(triangles)} triangles are cut where the cost is least", anchor="middle",
           size="head")
    draw_cuts(d, View((122, 114), 90), triangles)

    view = View((122, 452), 90)
    d.text(300, 366, "The node's eight children", anchor="middle", size="head")
    draw_triangles(d, view, triangles)
    parts = children_of(triangles)
    colors = ["blue", "orange", "green", "violet"]
    for k, part in enumerate(parts):
        color = colors[k % 4]
        low, high = box_of(part)
        d.polygon(view.all(corners((low, high))), color, tint=color)
        x, top = view(((low[0] + high[0]) / 2, high[1]))
        d.text(x, top + 17, str(len(part)), color, anchor="middle", bold=True, size="small")
    return d
