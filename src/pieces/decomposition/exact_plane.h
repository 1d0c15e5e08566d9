#pragma once

#include "math/predicates.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

/// The plane through three points, prepared for many side tests.
struct ExactPlane {
    ExactPlane() = default;
    ExactPlane(const Vec3& p, const Vec3& q, const Vec3& r) : a(p), b(q), c(r) {
        const Vec3 u = b - a, v = c - a;
        normal = cross(u, v);
        const double edge = std::max(max_abs(u), max_abs(v));
        // 3 products of 3 factors each, at most 9 roundings on any path: below 32 eps edge^2 reach.
        scale = 32 * 0x1p-53 * edge * edge;
    }
    explicit ExactPlane(const Triangle& t) : ExactPlane(t[0], t[1], t[2]) {}

    /// orient3d(a, b, c, p), exactly; 0 for all points if a, b, c lie on one line.
    [[nodiscard]] int side(const Vec3& p) const {
        const Vec3 w = p - a;
        const double s = dot(normal, w), reach = max_abs(w);
        // The last term covers underflow.
        const double bound = scale * reach + 0x1p-1000 * (reach + 1);
        if (std::abs(s) > bound)
            return s > 0 ? 1 : -1;
        return p == a || p == b || p == c ? 0 : orient3d(a, b, c, p);
    }

    Vec3 a, b, c, normal;
    double scale = 0;
};

} // namespace abut
