#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// Applies a transform to a point, term for term as include/abut/types.h states, so that results do
/// not depend on compiler flags.
inline Vec3 apply(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

/// Applies only the linear part.
inline Vec3 apply_linear(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

/// Applies the transposed linear part L^T: returns the d with d . v = n . (L v) for all v.
inline Vec3 pull_back(const Transform& t, const Vec3& n) {
    const auto& m = t.m;
    return {m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
            m[6] * n.x + m[7] * n.y + m[8] * n.z};
}

/// Sum of the magnitudes of the linear part's entries.
inline double sum_of_sizes(const Transform& t) {
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
        sum += std::abs(t.m[i]);
    return sum;
}

/// The transform followed by a translation in the world.
inline Transform translated(const Transform& t, const Vec3& shift) {
    Transform moved = t;
    moved.m[9] += shift.x, moved.m[10] += shift.y, moved.m[11] += shift.z;
    return moved;
}

/// Whether a transform turns right-handed axes into left-handed ones.
inline bool is_mirroring(const Transform& t) {
    const auto& m = t.m;
    return dot(cross(Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}), Vec3{m[6], m[7], m[8]}) < 0;
}

/// The transform that applies b, then a. It is rounded, so use it for bounds only.
Transform compose(const Transform& a, const Transform& b);

/// The inverse, rounded. A singular transform gives entries that are not finite.
Transform inverse(const Transform& t);

/// Bounds of |L v| over all unit vectors v, where L is a transform's linear part.
struct Stretch {
    double least = 0, most = 0;
};

/// Bounds how much a transform stretches vectors.
/// Accuracy    proven bounds, within 1e-5 of the singular values; 0 for a singular transform.
/// Source      Gershgorin discs of L^T L; its eigenvalues where the discs are too wide (shear,
///             uneven scale).
Stretch stretch_of(const Transform& t);

/// Errors      Error{bad_argument} if a value is not finite.
void require_finite(const Transform& t, const char* what);

} // namespace abut
