#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// The formula of include/abut/types.h, term for term: results depend on no compiler flag.
inline Vec3 apply(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

/// The linear part alone.
inline Vec3 apply_linear(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

/// By the transposed linear part L: the direction d with d . v = n . (L v) for all v.
inline Vec3 pull_back(const Transform& t, const Vec3& n) {
    const auto& m = t.m;
    return {m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
            m[6] * n.x + m[7] * n.y + m[8] * n.z};
}

/// Of the entries of the linear part.
inline double sum_of_sizes(const Transform& t) {
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
        sum += std::abs(t.m[i]);
    return sum;
}

/// With a translation of the world added.
inline Transform translated(const Transform& t, const Vec3& shift) {
    Transform moved = t;
    moved.m[9] += shift.x, moved.m[10] += shift.y, moved.m[11] += shift.z;
    return moved;
}

/// First b, then a: rounded, so for bounds only.
Transform compose(const Transform& a, const Transform& b);

/// Inverse, rounded; a singular map gives entries that are not finite.
Transform inverse(const Transform& t);

/// Bounds of |L v| over all unit vectors v, L the linear part of a transform.
struct Stretch {
    double least = 0, most = 0;
};

/// Accuracy    proven bounds, within 1e-5 of the singular values; 0 for a singular map.
/// Source      Gershgorin discs of L^T L; its eigenvalues where the discs are too wide (shear,
///             uneven scale).
Stretch stretch_of(const Transform& t);

/// Errors      Error{bad_argument} if a value is not finite.
void require_finite(const Transform& t, const char* what);

} // namespace abut
