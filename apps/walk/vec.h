#pragma once

#include <abut/types.h>

#include <algorithm>
#include <cmath>

/// Arithmetic of vectors for the viewer, which includes public headers only.
namespace abut::viewer {

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

} // namespace abut::viewer
