#pragma once

#include <abut/vector.h>

#include <array>

/// Rotations, as a simulator needs them.
namespace drop {

using namespace abut::vectors;
using abut::Transform;
using abut::Vec3;
using Quaternion = std::array<double, 4>; ///< w, x, y, z

/// R v, and below R^-1 v.
inline Vec3 turned(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}
inline Vec3 turned_back(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
inline Vec3 origin(const Transform& t) {
    return {t.m[9], t.m[10], t.m[11]};
}

/// Applies `q`, then the rotation by |w| about w.
inline Quaternion rotated(const Quaternion& q, const Vec3& w) {
    const double angle = length(w), s = angle > 0 ? std::sin(0.5 * angle) / angle : 0.5;
    const double c = std::cos(0.5 * angle);
    const Vec3 u = s * w, v{q[1], q[2], q[3]};
    const Vec3 imaginary = c * v + q[0] * u + cross(u, v);
    const double real = c * q[0] - dot(u, v);
    const double norm = std::sqrt(real * real + dot(imaginary, imaginary));
    return {real / norm, imaginary.x / norm, imaginary.y / norm, imaginary.z / norm};
}

} // namespace drop
