#pragma once

#include <abut/types.h>

#include <cmath>

/// What a simulator computes with, on the library's plain vectors.
namespace drop {

using abut::Transform;
using abut::Vec3;
using Quaternion = std::array<double, 4>; ///< w, x, y, z

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(double s, const Vec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

/// R v, and its inverse.
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

/// First `q`, then the rotation by |w| about w.
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
