#pragma once

#include <abut/types.h>
#include <abut/vector.h>

#include <algorithm>
#include <array>

/// Geometry of the viewer beside abut/vector.h.
namespace abut::viewer {

inline Vec3 unit(const Vec3& a) {
    const double l = length(a);
    return l > 0 ? (1 / l) * a : a;
}
inline Vec3 middle(const Box3& box) {
    return 0.5 * (box.lower + box.upper);
}
inline double diagonal(const Box3& box) {
    return std::max(0.0, length(box.upper - box.lower));
}
inline Vec3 axis(int i) {
    return {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
}

using Quaternion = std::array<double, 4>; ///< w, x, y, z

/// The product of two rotations: b first, then a.
inline Quaternion product(const Quaternion& a, const Quaternion& b) {
    const Vec3 u{a[1], a[2], a[3]}, v{b[1], b[2], b[3]};
    const Vec3 w = a[0] * v + b[0] * u + cross(u, v);
    const double real = a[0] * b[0] - dot(u, v);
    const double norm = std::sqrt(real * real + dot(w, w));
    return {real / norm, w.x / norm, w.y / norm, w.z / norm};
}
/// The rotation about a unit vector, in radians.
inline Quaternion rotation_about(const Vec3& axis, double angle) {
    const Vec3 v = std::sin(0.5 * angle) * axis;
    return {std::cos(0.5 * angle), v.x, v.y, v.z};
}
inline Vec3 apply(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}
/// The box around a box that a transform moves.
inline Box3 moved(const Transform& t, const Box3& box) {
    Box3 around;
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3 p = apply(t, {(i & 1) != 0 ? box.upper.x : box.lower.x,
                                 (i & 2) != 0 ? box.upper.y : box.lower.y,
                                 (i & 4) != 0 ? box.upper.z : box.lower.z});
        around.lower = {std::min(around.lower.x, p.x), std::min(around.lower.y, p.y),
                        std::min(around.lower.z, p.z)};
        around.upper = {std::max(around.upper.x, p.x), std::max(around.upper.y, p.y),
                        std::max(around.upper.z, p.z)};
    }
    return around;
}

} // namespace abut::viewer
