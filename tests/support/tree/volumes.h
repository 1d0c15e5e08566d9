#pragma once

#include "tests/support/oracle/precise_distance.h"
#include "tests/support/random.h"
#include "volume/kdop.h"
#include "volume/obb.h"
#include "volume/sphere.h"
#include "volume/ssv.h"
#include "volume/swept_sphere.h"

#include <vector>

/// Checks with 100 digits whether bounding volumes enclose what they should.
namespace abut::test {

inline PrecisePoint precise(const std::array<float, 3>& v) {
    return {Precise(v[0]), Precise(v[1]), Precise(v[2])};
}
inline Precise determinant(const PrecisePoint& a, const PrecisePoint& b, const PrecisePoint& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Coordinates along the axes, p = centre + sum_i s_i axis_i, by Cramer's rule.
inline bool encloses(const Obb& box, const Vec3& p, double radius = 0) {
    const PrecisePoint d = precise(p) - precise(box.centre);
    const PrecisePoint a = precise(box.axis[0]), b = precise(box.axis[1]), c = precise(box.axis[2]);
    const Precise whole = determinant(a, b, c);
    const std::array<Precise, 3> s{determinant(d, b, c) / whole, determinant(a, d, c) / whole,
                                   determinant(a, b, d) / whole};
    for (std::size_t i = 0; i < 3; ++i)
        if (abs(s[i]) + radius > Precise(box.half[i]))
            return false;
    return true;
}

/// Distance to the core, which is a point, a segment or a parallelogram.
template <std::size_t n>
Precise distance_to_core(const SweptSphere<n>& swept, const Vec3& point) {
    const PrecisePoint p = precise(point), centre = precise(swept.centre);
    const auto corner = [&](const std::array<int, 2>& sign) {
        PrecisePoint x = centre;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                x[k] += sign[i] * Precise(swept.axes[i].half) * swept.axes[i].direction[k];
        return x;
    };
    if constexpr (n == 0) {
        return precise_root(dot(p - centre, p - centre));
    } else if constexpr (n == 1) {
        return precise_root(point_segment_sq(p, corner({-1, 0}), corner({1, 0})));
    } else {
        const PreciseTriangle below{corner({-1, -1}), corner({1, -1}), corner({1, 1})},
            above{corner({-1, -1}), corner({1, 1}), corner({-1, 1})};
        Precise best = dot(p - centre, p - centre);
        for (const PreciseTriangle& t : {below, above}) {
            for (std::size_t i = 0; i < 3; ++i)
                keep_least(best, point_segment_sq(p, t[i], t[(i + 1) % 3]));
            keep_foot(best, p, t);
        }
        return precise_root(best);
    }
}
template <std::size_t n>
bool encloses(const SweptSphere<n>& swept, const Vec3& p, double radius = 0) {
    return distance_to_core(swept, p) + radius <= Precise(swept.radius);
}

template <std::size_t k>
bool encloses(const Kdop<k>& kdop, const Vec3& p, double radius = 0) {
    const PrecisePoint x = precise(p);
    for (std::size_t i = 0; i < Kdop<k>::kSlabs; ++i) {
        const auto& n = Kdop<k>::kNormals[i];
        const Precise along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
        const double off = radius * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (along - off < Precise(kdop.lower[i]) || along + off > Precise(kdop.upper[i]))
            return false;
    }
    return true;
}

/// Sets of triangles as leaves and subtrees hold them, and extreme ones.
inline std::vector<Triangle> any_triangles(Random& random, int kind) {
    const int count = random.integer(1, 40);
    const double size = std::pow(10.0, random.integer(-3, 3));
    const Vec3 centre = random.in_cube(kind % 3 == 0 ? 1e4 * size : size);
    const Vec3 u = random.direction(), v = random.direction(), w = random.direction();
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; ++i) {
        Triangle t;
        for (Vec3& p : t) {
            const Vec3 s = random.in_cube(size);
            switch (kind % 7) {
            case 0:
                p = centre + s;
                break; // a cube
            case 1:
                p = centre + s.x * u + 0.1 * s.y * v + 0.01 * s.z * w;
                break; // a slanted slab
            case 2:
                p = centre + s.x * u + 0.5 * s.y * v;
                break; // flat to rounding
            case 3:
                p = {centre.x + s.x, centre.y + s.y, centre.z};
                break; // flat
            case 4:
                p = centre + s.x * u;
                break; // a line
            case 5:
                p = centre;
                break; // a point
            default:
                p = centre + size * random.direction();
                break; // a sphere
            }
        }
        triangles.push_back(t);
    }
    return triangles;
}

} // namespace abut::test
