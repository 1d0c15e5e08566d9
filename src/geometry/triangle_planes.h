#pragma once

#include "math/predicates.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

/// Positions of two triangles relative to each other's planes. The intersection test and the common
/// segment both begin with them.
namespace abut::triangle_planes {

using Signs = std::array<int, 3>;

/// The side of the plane of `plane` on which each of some points lies. One normal serves the
/// filters of all.
template <std::size_t count>
std::array<int, count> plane_sides(const Triangle& plane, const std::array<Vec3, count>& points) {
    const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0];
    const Vec3 n = cross(u, v);
    const auto largest = [](const Vec3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    };
    const double edge = std::max(largest(u), largest(v));
    std::array<int, count> signs{};
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 w = points[i] - plane[0];
        const double side = dot(n, w), reach = largest(w);
        // 3 products of 3 factors each, at most 9 roundings on any path: below 32 eps edge^2 reach.
        // The last term covers underflow.
        const double bound = 32 * 0x1p-53 * edge * edge * reach + 0x1p-1000 * (reach + 1);
        signs[i] = side > bound    ? 1
                   : side < -bound ? -1
                                   : orient3d(plane[0], plane[1], plane[2], points[i]);
    }
    return signs;
}

inline bool strictly_one_side(const Signs& s) {
    return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
}
inline bool all_zero(const Signs& s) {
    return s[0] == 0 && s[1] == 0 && s[2] == 0;
}
inline bool straddles(const Signs& s) {
    return (s[0] > 0 || s[1] > 0 || s[2] > 0) && (s[0] < 0 || s[1] < 0 || s[2] < 0);
}

/// A triangle cut by a plane: both edges from the apex meet the plane.
struct Cut {
    const Vec3 *apex, *left, *right; ///< in the triangle's own cyclic order
    int side;                        ///< of the apex, seen from the plane's triangle: +1 or -1
};

/// In: signs that are neither all equal nor all zero.
inline Cut cut(const Triangle& t, const Signs& s) {
    // The apex is a vertex whose sign differs from the others', which are not on opposite sides.
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        if (s[i] != s[j] && s[i] != s[k] && s[j] * s[k] >= 0)
            return {&t[i], &t[j], &t[k], s[i] != 0 ? s[i] : -(s[j] + s[k])};
    }
    return {}; // not reached
}

/// Both triangles' intervals on the line in which their planes meet, directed along n_a x n_b. Each
/// interval ends where an edge from the triangle's apex meets the other's plane.
struct LineIntervals {
    const Vec3 *a_apex, *a_first, *a_last;
    const Vec3 *b_apex, *b_first, *b_last;
    int sides;

    /// Compares two interval ends on the line, one on an edge from a's apex, one on an edge from
    /// b's: +1 if a's comes first, 0 if they coincide, otherwise -1. Exact: the sign of
    ///
    ///     side_a side_b orient3d(apex_a, end_a, apex_b, end_b)
    [[nodiscard]] int before(const Vec3* end_a, const Vec3* end_b) const {
        return sides * orient3d(*a_apex, *end_a, *b_apex, *end_b);
    }
};

/// In: each plane cuts the other triangle. The cyclic order of each triangle tells which of its two
/// edges comes first.
inline LineIntervals line_intervals(const Triangle& a, const Signs& a_sides, const Triangle& b,
                                    const Signs& b_sides) {
    const Cut ca = cut(a, a_sides), cb = cut(b, b_sides);
    return {ca.apex,          ca.side > 0 ? ca.right : ca.left, ca.side > 0 ? ca.left : ca.right,
            cb.apex,          cb.side > 0 ? cb.left : cb.right, cb.side > 0 ? cb.right : cb.left,
            ca.side * cb.side};
}

/// The end points of a collinear triangle: the lexicographically least and greatest vertex.
inline std::array<Vec3, 2> end_points(const Triangle& t) {
    const auto less = [](const Vec3& p, const Vec3& q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    const auto [least, greatest] = std::minmax({t[0], t[1], t[2]}, less);
    return {least, greatest};
}

} // namespace abut::triangle_planes
