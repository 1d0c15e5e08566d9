#pragma once

#include <abut/types.h>
#include <abut/vector.h>

#include <array>
#include <cmath>

/// Vectors, matrices and rotations, as a simulator needs them.
namespace simulation {

using abut::cross, abut::dot, abut::length;
using abut::Pose;
using abut::Vec3;
using Quaternion = std::array<double, 4>; ///< w, x, y, z; of unit length

/// A 3x3 matrix by its columns.
struct Matrix {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};
inline constexpr Matrix kZeroMatrix{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};

inline Vec3 operator*(const Matrix& m, const Vec3& v) {
    return {m.x.x * v.x + m.y.x * v.y + m.z.x * v.z, m.x.y * v.x + m.y.y * v.y + m.z.y * v.z,
            m.x.z * v.x + m.y.z * v.y + m.z.z * v.z};
}
inline Matrix operator*(const Matrix& m, const Matrix& n) {
    return {m * n.x, m * n.y, m * n.z};
}
inline Matrix operator+(const Matrix& m, const Matrix& n) {
    return {m.x + n.x, m.y + n.y, m.z + n.z};
}
inline Matrix operator*(double s, const Matrix& m) {
    return {s * m.x, s * m.y, s * m.z};
}
inline Matrix transposed(const Matrix& m) {
    return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
inline Matrix inverse(const Matrix& m) {
    const Vec3 a = cross(m.y, m.z), b = cross(m.z, m.x), c = cross(m.x, m.y);
    return (1 / dot(m.x, a)) * transposed({a, b, c});
}
/// The matrix of the map v -> w x v.
inline Matrix cross_matrix(const Vec3& w) {
    return {{0, w.z, -w.y}, {-w.z, 0, w.x}, {w.y, -w.x, 0}};
}
/// The matrix of the map v -> (p . v) p.
inline Matrix outer_square(const Vec3& p) {
    return {p.x * p, p.y * p, p.z * p};
}

inline Vec3 unit(const Vec3& v) {
    return (1 / length(v)) * v;
}
/// Returns a unit vector across a unit vector.
inline Vec3 across(const Vec3& n) {
    return unit(std::abs(n.x) > 0.6 ? Vec3{-n.y, n.x, 0} : Vec3{0, -n.z, n.y});
}

inline Quaternion normalised(const Quaternion& q) {
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
}
inline Quaternion conjugate(const Quaternion& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}
/// The rotation q followed by the rotation p.
inline Quaternion product(const Quaternion& p, const Quaternion& q) {
    const Vec3 u{p[1], p[2], p[3]}, v{q[1], q[2], q[3]};
    const Vec3 imaginary = p[0] * v + q[0] * u + cross(u, v);
    return {p[0] * q[0] - dot(u, v), imaginary.x, imaginary.y, imaginary.z};
}
inline Matrix rotation_matrix(const Quaternion& q) {
    const auto& [w, x, y, z] = q;
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}
/// Applies `q`, then the rotation by |w| about w.
inline Quaternion rotated(const Quaternion& q, const Vec3& w) {
    const double angle = length(w), s = angle > 0 ? std::sin(0.5 * angle) / angle : 0.5;
    return normalised(product({std::cos(0.5 * angle), s * w.x, s * w.y, s * w.z}, q));
}

} // namespace simulation
