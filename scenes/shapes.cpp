#include "scenes/shapes.h"

#include "scenes/deforming/frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace abut::scenes {
namespace {

using Index = std::uint32_t;

Index vertex(Shape& shape, double x, double y, double z) {
    // Multiples of 2^-16 m are exact as floats up to 256 m, and their sums are exact as doubles.
    const auto exact = [](double v) { return std::floor(v * 0x1p16 + 0.5) * 0x1p-16; };
    shape.mesh.positions.push_back({exact(x), exact(y), exact(z)});
    return static_cast<Index>(shape.mesh.positions.size() - 1);
}

void triangle(Shape& shape, Index a, Index b, Index c) {
    shape.mesh.triangles.push_back({a, b, c});
}

/// The corners come in braces, so that corners created in the argument are created in their order.
void quad(Shape& shape, const std::array<Index, 4>& corner) {
    triangle(shape, corner[0], corner[1], corner[2]);
    triangle(shape, corner[0], corner[2], corner[3]);
}

/// Covers the shape with one box.
Shape& boxed(Shape& shape) {
    Box3 bounds;
    for (const Vec3& p : shape.mesh.positions) {
        extend(bounds, p);
    }
    shape.cover = {bounds};
    return shape;
}

double area2(const Point2& a, const Point2& b, const Point2& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Ear clipping. Sections have only a dozen corners.
std::vector<std::array<Index, 3>> triangulate(const std::vector<Point2>& polygon) {
    std::vector<Index> left(polygon.size());
    for (Index i = 0; i < left.size(); ++i) {
        left[i] = i;
    }
    std::vector<std::array<Index, 3>> result;
    for (std::size_t i = 0; left.size() > 3;) {
        const std::size_t n = left.size();
        const std::array<Index, 3> ear{left[i % n], left[(i + 1) % n], left[(i + 2) % n]};
        const Point2 &a = polygon[ear[0]], &b = polygon[ear[1]], &c = polygon[ear[2]];
        const bool blocked = area2(a, b, c) <= 0 || std::ranges::any_of(left, [&](Index k) {
                                 const Point2& p = polygon[k];
                                 return k != ear[0] && k != ear[1] && k != ear[2] &&
                                        area2(a, b, p) >= 0 && area2(b, c, p) >= 0 &&
                                        area2(c, a, p) >= 0;
                             });
        if (blocked && i < 1000) {
            ++i;
            continue;
        }
        result.push_back(ear);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>((i + 1) % n));
        i = 0;
    }
    result.push_back({left[0], left[1], left[2]});
    return result;
}

/// A ring of vertices around the x axis.
Index ring_of(Shape& shape, double x, double radius, int sides) {
    const auto first = static_cast<Index>(shape.mesh.positions.size());
    for (int k = 0; k < sides; ++k) {
        const Point2 c = on_circle(k, sides);
        vertex(shape, x, radius * c.u, radius * c.v);
    }
    return first;
}

void join_rings(Shape& shape, Index from, Index to, int sides) {
    const auto n = static_cast<Index>(sides);
    for (Index k = 0; k < n; ++k) {
        const Index next = (k + 1) % n;
        quad(shape, {from + k, from + next, to + next, to + k});
    }
}

void cap(Shape& shape, Index ring, int sides, bool faces_forward) {
    for (Index k = 1; k + 1 < static_cast<Index>(sides); ++k) {
        faces_forward ? triangle(shape, ring, ring + k, ring + k + 1)
                      : triangle(shape, ring, ring + k + 1, ring + k);
    }
}

void pole(Shape& shape, Index tip, Index ring, int sides, bool faces_forward) {
    const auto n = static_cast<Index>(sides);
    for (Index k = 0; k < n; ++k) {
        const Index next = (k + 1) % n;
        faces_forward ? triangle(shape, ring + k, ring + next, tip)
                      : triangle(shape, ring + next, ring + k, tip);
    }
}

/// Sheet metal: strips along x for the segments of a profile, open at both ends.
Shape sheet(double length, const std::vector<Point2>& profile, bool round) {
    Shape shape;
    shape.closed = false;
    for (const Point2& p : profile) {
        vertex(shape, 0, p.u, p.v);
        vertex(shape, length, p.u, p.v);
    }
    const auto n = static_cast<Index>(profile.size());
    for (Index k = 0; k + (round ? 0 : 1) < n; ++k) {
        const Index next = (k + 1) % n;
        quad(shape, {2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
    }
    return boxed(shape);
}

} // namespace

Point2 on_circle(int k, int n) {
    // Uses Taylor's series: the library's sine may differ in the last digit from machine to
    // machine.
    const int eighths = 8 * (((k % n) + n) % n); // turn = eighths / (8 n)
    const int quadrant = eighths / (2 * n);
    const double angle = (eighths - quadrant * 2 * n) * (std::numbers::pi / 4) / n; // [0, pi/2)
    double cosine = 1, sine = angle, term = angle;
    double even = 1;
    for (int i = 1; i < 12; ++i) {
        even *= -angle * angle / ((2 * i - 1) * (2 * i));
        term *= -angle * angle / ((2 * i) * (2 * i + 1));
        cosine += even;
        sine += term;
    }
    switch (quadrant) {
    case 0:
        return {cosine, sine};
    case 1:
        return {-sine, cosine};
    case 2:
        return {-cosine, -sine};
    default:
        return {sine, -cosine};
    }
}

void append(Shape& whole, const Shape& piece, const Transform& whole_from_piece) {
    const auto first = static_cast<Index>(whole.mesh.positions.size());
    for (const Vec3& p : piece.mesh.positions) {
        const Vec3 q = apply(whole_from_piece, p);
        vertex(whole, q.x, q.y, q.z);
    }
    for (const auto& t : piece.mesh.triangles) {
        triangle(whole, first + t[0], first + t[1], first + t[2]);
    }
    for (const Box3& cover : piece.cover) {
        whole.cover.push_back(moved(whole_from_piece, cover));
    }
    whole.closed = whole.closed && piece.closed;
}

Shape box(const Box3& b) {
    Shape shape;
    for (int corner = 0; corner < 8; ++corner) {
        vertex(shape, (corner & 1) != 0 ? b.upper.x : b.lower.x,
               (corner & 2) != 0 ? b.upper.y : b.lower.y,
               (corner & 4) != 0 ? b.upper.z : b.lower.z);
    }
    quad(shape, {0, 4, 6, 2}); // -x
    quad(shape, {1, 3, 7, 5}); // +x
    quad(shape, {0, 1, 5, 4}); // -y
    quad(shape, {2, 6, 7, 3}); // +y
    quad(shape, {0, 2, 3, 1}); // -z
    quad(shape, {4, 5, 7, 6}); // +z
    return boxed(shape);
}

Shape block(double size_x, double height, double size_z) {
    return box({{-size_x / 2, 0, -size_z / 2}, {size_x / 2, height, size_z / 2}});
}

Shape bar(double length, double height, double width) {
    return box({{0, -height / 2, -width / 2}, {length, height / 2, width / 2}});
}

Shape prism(double length, const std::vector<Point2>& section) {
    Shape shape;
    const auto n = static_cast<Index>(section.size());
    for (const double x : {0.0, length}) {
        for (const Point2& p : section) {
            vertex(shape, x, p.u, p.v);
        }
    }
    for (Index k = 0; k < n; ++k) {
        const Index next = (k + 1) % n;
        quad(shape, {k, next, n + next, n + k});
    }
    for (const auto& t : triangulate(section)) {
        triangle(shape, t[0], t[2], t[1]);
        triangle(shape, n + t[0], n + t[1], n + t[2]);
    }
    return boxed(shape);
}

Shape i_section(double length, double depth, double width, double web, double flange) {
    const double h = depth / 2, f = depth / 2 - flange, w = width / 2, s = web / 2;
    return prism(length, {{-h, -w},
                          {-f, -w},
                          {-f, -s},
                          {f, -s},
                          {f, -w},
                          {h, -w},
                          {h, w},
                          {f, w},
                          {f, s},
                          {-f, s},
                          {-f, w},
                          {-h, w}});
}

Shape hollow_section(double length, double depth, double width, double wall) {
    Shape shape;
    std::array<Index, 4> ring{}; // outer at 0, outer at length, inner at length, inner at 0
    const std::array<Point2, 4> corner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (Index k = 0; k < 4; ++k) {
        const double inset = k < 2 ? 0 : wall;
        ring[k] = static_cast<Index>(shape.mesh.positions.size());
        for (const Point2& c : corner) {
            vertex(shape, k == 1 || k == 2 ? length : 0, c.u * (depth / 2 - inset),
                   c.v * (width / 2 - inset));
        }
    }
    for (Index k = 0; k < 4; ++k) {
        join_rings(shape, ring[k], ring[(k + 1) % 4], 4);
    }
    boxed(shape);
    // Braces lie askew: several short boxes cover them more tightly than one.
    const int pieces = std::max(1, static_cast<int>(length / 0.25));
    const Box3 whole = shape.cover[0];
    shape.cover.clear();
    shape.cover.reserve(static_cast<std::size_t>(pieces));
    for (int k = 0; k < pieces; ++k) {
        shape.cover.push_back({{length * k / pieces, whole.lower.y, whole.lower.z},
                               {length * (k + 1) / pieces, whole.upper.y, whole.upper.z}});
    }
    return shape;
}

Shape plate(const std::vector<double>& x_cuts, const std::vector<double>& z_cuts, double y_low,
            double y_high, const std::function<bool(std::size_t, std::size_t)>& solid) {
    Shape shape;
    const std::size_t nx = x_cuts.size() - 1, nz = z_cuts.size() - 1;
    const auto filled = [&](std::size_t i, std::size_t k) {
        return i < nx && k < nz && solid(i, k);
    };
    std::vector<Index> at_corner(2 * (nx + 1) * (nz + 1), ~Index{0});
    const auto corner = [&](std::size_t i, std::size_t k, bool top) {
        Index& index = at_corner[2 * (i * (nz + 1) + k) + (top ? 1 : 0)];
        if (index == ~Index{0}) {
            index = vertex(shape, x_cuts[i], top ? y_high : y_low, z_cuts[k]);
        }
        return index;
    };
    const auto wall = [&](std::size_t i0, std::size_t k0, std::size_t i1, std::size_t k1) {
        quad(shape, {corner(i0, k0, false), corner(i0, k0, true), corner(i1, k1, true),
                     corner(i1, k1, false)});
    };
    for (std::size_t i = 0; i < nx; ++i) {
        for (std::size_t k = 0; k < nz; ++k) {
            if (!filled(i, k)) {
                continue;
            }
            quad(shape, {corner(i, k, true), corner(i, k + 1, true), corner(i + 1, k + 1, true),
                         corner(i + 1, k, true)});
            quad(shape, {corner(i, k, false), corner(i + 1, k, false), corner(i + 1, k + 1, false),
                         corner(i, k + 1, false)});
            if (i == 0 || !filled(i - 1, k)) {
                wall(i, k + 1, i, k);
            }
            if (!filled(i + 1, k)) {
                wall(i + 1, k, i + 1, k + 1);
            }
            if (k == 0 || !filled(i, k - 1)) {
                wall(i, k, i + 1, k);
            }
            if (!filled(i, k + 1)) {
                wall(i + 1, k + 1, i, k + 1);
            }
            const bool grows = k > 0 && filled(i, k - 1);
            if (grows) {
                shape.cover.back().upper.z = z_cuts[k + 1];
            } else {
                shape.cover.push_back(
                    {{x_cuts[i], y_low, z_cuts[k]}, {x_cuts[i + 1], y_high, z_cuts[k + 1]}});
            }
        }
    }
    return shape;
}

Shape lathe(const std::vector<Point2>& profile, int sides, bool ring) {
    Shape shape;
    std::vector<Index> rings;
    rings.reserve(profile.size());
    for (const Point2& p : profile) {
        rings.push_back(p.v == 0 ? vertex(shape, p.u, 0, 0) : ring_of(shape, p.u, p.v, sides));
    }
    const std::size_t n = profile.size();
    for (std::size_t k = 0; k + (ring ? 0 : 1) < n; ++k) {
        const std::size_t next = (k + 1) % n;
        if (profile[k].v == 0) {
            pole(shape, rings[k], rings[next], sides, false);
        } else if (profile[next].v == 0) {
            pole(shape, rings[next], rings[k], sides, true);
        } else {
            join_rings(shape, rings[k], rings[next], sides);
        }
    }
    if (!ring && profile.front().v != 0) {
        cap(shape, rings.front(), sides, false);
    }
    if (!ring && profile.back().v != 0) {
        cap(shape, rings.back(), sides, true);
    }
    return boxed(shape);
}

Shape elbow(double radius, double bend, int sides, int steps) {
    Shape shape;
    Index before = 0;
    for (int step = 0; step <= steps; ++step) {
        const Point2 phi = on_circle(step, 4 * steps);
        const auto ring = static_cast<Index>(shape.mesh.positions.size());
        for (int k = 0; k < sides; ++k) {
            const Point2 c = on_circle(k, sides);
            const double out = bend - radius * c.u; // distance from the bend's centre
            vertex(shape, out * phi.v, bend - out * phi.u, radius * c.v);
        }
        step == 0 ? cap(shape, ring, sides, false) : join_rings(shape, before, ring, sides);
        before = ring;
    }
    cap(shape, before, sides, true);
    return boxed(shape);
}

Shape tray(double length, double width, double height) {
    const double w = width / 2, lip = height / 5;
    return sheet(length,
                 {{height, lip - w}, {height, -w}, {0, -w}, {0, w}, {height, w}, {height, w - lip}},
                 false);
}

Shape duct(double length, double height, double width) {
    const double h = height / 2, w = width / 2;
    return sheet(length, {{-h, -w}, {h, -w}, {h, w}, {-h, w}}, true);
}

Shape cladding(double length, double width, double depth, int waves) {
    std::vector<Point2> profile;
    for (int k = 0; k < waves; ++k) {
        const double z = width * k / waves, quarter = width / waves / 4;
        profile.insert(
            profile.end(),
            {{0, z}, {0, z + quarter}, {depth, z + 2 * quarter}, {depth, z + 3 * quarter}});
    }
    profile.push_back({0, width});
    return sheet(length, profile, false);
}

Shape wedge(double length, double height, double width) {
    return prism(length, {{0, 0}, {height, -width / 2}, {height, width / 2}});
}

Shape octahedron(double radius) {
    Shape shape;
    const Index low = vertex(shape, 0, 0, 0), high = vertex(shape, 0, 2 * radius, 0);
    const std::array<Index, 4> belt{
        vertex(shape, radius, radius, 0), vertex(shape, 0, radius, radius),
        vertex(shape, -radius, radius, 0), vertex(shape, 0, radius, -radius)};
    for (std::size_t k = 0; k < 4; ++k) {
        triangle(shape, low, belt[k], belt[(k + 1) % 4]);
        triangle(shape, high, belt[(k + 1) % 4], belt[k]);
    }
    return boxed(shape);
}

} // namespace abut::scenes
