"""Point, line and rectangle swept spheres around one plate (docs/volumes.md).

The fit is that of src/volume/swept_sphere.cpp: axes by extent, radius from the extents across the
core, ends of the core inset as far as the round ends reach, corners moved out, radius at last.
"""
import math

from drawing import Drawing, View
from geometry import convex_hull, dot, mul, principal_axes, turned

OUTLINE = [(-2.0, -0.7), (1.2, -1.0), (2.0, -0.55), (2.1, 0.25), (0.75, 0.45), (0.3, 1.0),
           (-1.3, 0.95), (-1.95, 0.3)]
HALF_THICKNESS, BEVEL = 0.36, 0.72
TILT = math.radians(24)


def plate(outline):
    """Corners of the rim and of both flat sides."""
    return [(x, y, 0.0) for x, y in outline] + [
        (BEVEL * x, BEVEL * y, z) for z in (-HALF_THICKNESS, HALF_THICKNESS) for x, y in outline]


def hull_axes(outline):
    """In-plane axes of the surface of the plate's hull, weighted by area. Both halves are alike."""
    rim = [(x, y, 0.0) for x, y in convex_hull(outline)]
    flat = [(BEVEL * x, BEVEL * y, HALF_THICKNESS) for x, y, _ in rim]
    triangles = [(flat[0], flat[i], flat[i + 1]) for i in range(1, len(flat) - 1)]
    for i in range(len(rim)):
        k = (i + 1) % len(rim)
        triangles += [(rim[i], rim[k], flat[k]), (rim[i], flat[k], flat[i])]
    total = x = y = xx = xy = yy = 0.0
    for p, q, r in triangles:
        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        area = math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0])
        c = [sum(t) / 3 for t in zip(p, q, r)]
        total, x, y = total + area, x + area * c[0], y + area * c[1]
        for point, share in ((c, 9 / 12), (p, 1 / 12), (q, 1 / 12), (r, 1 / 12)):
            xx += area * share * point[0] * point[0]
            xy += area * share * point[0] * point[1]
            yy += area * share * point[1] * point[1]
    x, y = x / total, y / total
    return principal_axes(xx / total - x * x, xy / total - x * y, yy / total - y * y)


def fit(outline, axes, dimension):
    """Centre (along the axes), half lengths of the core, and radius."""
    points = [(dot(p[:2], axes[0]), dot(p[:2], axes[1]), p[2]) for p in plate(outline)]
    middle = [(min(p[i] for p in points) + max(p[i] for p in points)) / 2 for i in range(3)]
    points = [tuple(p[i] - middle[i] for i in range(3)) for p in points]
    radius = max(math.hypot(*p[dimension:]) for p in points)
    core = []
    for i in range(dimension):
        reach = [math.sqrt(max(0, radius**2 - sum(x * x for x in p[dimension:]))) for p in points]
        low = min(p[i] + r for p, r in zip(points, reach))
        high = max(p[i] - r for p, r in zip(points, reach))
        core.append((low, high) if low <= high else ((low + high) / 2,) * 2)
    if dimension == 2:
        grown = [list(c) for c in core]
        for p in points:
            beyond = [max(p[i] - core[i][1], core[i][0] - p[i], 0) for i in (0, 1)]
            excess = beyond[0] ** 2 + beyond[1] ** 2 + p[2] ** 2 - radius**2
            if min(beyond) <= 0 or excess <= 0:
                continue
            m = (sum(beyond) - math.sqrt(max(0, sum(beyond) ** 2 - 2 * excess))) / 2
            for i in (0, 1):
                if p[i] > core[i][1]:
                    grown[i][1] = max(grown[i][1], core[i][1] + m)
                else:
                    grown[i][0] = min(grown[i][0], core[i][0] - m)
        core = [tuple(g) for g in grown]
    half = [(high - low) / 2 for low, high in core] + [0, 0]
    shift = [(low + high) / 2 for low, high in core] + [0, 0]
    radius = max(math.hypot(*(max(0, abs(p[i] - (shift[i] if i < dimension else 0))
                                  - (half[i] if i < dimension else 0)) for i in range(3)))
                 for p in points)
    return (middle[0] + shift[0], middle[1] + shift[1]), half[:2], radius


def volume(half, r):
    a, b = 2 * half[0], 2 * half[1]
    return 4 / 3 * math.pi * r**3 + math.pi * r * r * (a + b) + 2 * r * a * b


def draw():
    d = Drawing(290, "Point, line and rectangle swept spheres around one plate")
    outline = [turned(p, TILT) for p in OUTLINE]
    axes = hull_axes(outline)
    names = ("Point (PSS)", "Line (LSS)", "Rectangle (RSS)")
    volumes = []
    for dimension, name in enumerate(names):
        (cx, cy), half, r = fit(outline, axes, dimension)
        volumes.append(volume(half, r))
        view = View((100 + 200 * dimension, 138), 36)

        def at(x, y):
            return view((x * axes[0][0] + y * axes[1][0], x * axes[0][1] + y * axes[1][1]))

        boundary = []
        for quadrant, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
            for k in range(25):
                angle = math.pi / 2 * (quadrant + k / 24)
                boundary.append(at(cx + sx * half[0] + r * math.cos(angle),
                                   cy + sy * half[1] + r * math.sin(angle)))
        d.polygon(boundary, "blue", tint="blue")
        d.polygon(view.all(outline), "ink", tint="ink")
        d.polygon(view.all([mul(BEVEL, p) for p in outline]), "ink", width="thin")
        if dimension == 0:
            d.dot(at(cx, cy), "orange", 4.5)
        elif dimension == 1:
            d.line(at(cx - half[0], cy), at(cx + half[0], cy), "orange", width="bold")
        else:
            d.polygon([at(cx + sx * half[0], cy + sy * half[1])
                       for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))], "orange", tint="orange",
                      width="bold")
        start = (cx + half[0], cy + half[1])
        d.arrow(at(*start), at(start[0] + r * 0.6, start[1] + r * 0.8), "orange")
        d.text(100 + 200 * dimension, 22, name, anchor="middle", size="head")
        share = round(100 * volumes[-1] / volumes[0])
        d.text(100 + 200 * dimension, 256, f"volume {share} %", anchor="middle")
    d.text(300, 281, "A bevelled plate, the core (orange), and all points within r of the core",
           anchor="middle", color="muted", size="small")
    return d
