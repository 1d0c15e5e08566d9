#pragma once

#include "math/rounding.h"
#include "math/vector.h"
#include "volume/relative_pose.h"

#include <array>

/// Vectors in single precision, as volumes store them. Every function rounds; margins account for
/// it.
namespace abut {

using Float3 = std::array<float, 3>;

/// Outweighs what squares and products of doubles lose below the range of normal numbers.
inline constexpr double kUnderflow = 0x1p-500;

inline Vec3 to_double(const Float3& v) {
    return {v[0], v[1], v[2]};
}
inline Float3 to_float(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}
inline float dot(const Float3& a, const Float3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Float3 cross(const Float3& a, const Float3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Float3 scaled(float s, const Float3& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
/// a - s b
inline Float3 minus_scaled(const Float3& a, float s, const Float3& b) {
    return {a[0] - s * b[0], a[1] - s * b[1], a[2] - s * b[2]};
}
inline Float3 apply_linear(const RelativePose& pose, const Float3& v) {
    const auto& m = pose.linear;
    return {m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
            m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
            m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2]};
}
inline Float3 apply(const RelativePose& pose, const Float3& p) {
    const Float3 v = apply_linear(pose, p);
    return {v[0] + pose.translation[0], v[1] + pose.translation[1], v[2] + pose.translation[2]};
}

} // namespace abut
