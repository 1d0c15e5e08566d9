#pragma once

#include <abut/vector.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

using Triangle = std::array<Vec3, 3>;

inline double length_sq(const Vec3& a) {
    return dot(a, a);
}
inline Vec3 normalized_or_zero(const Vec3& a) {
    const double l = length(a);
    return l > 0 ? (1 / l) * a : Vec3{};
}
inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The largest magnitude of the coordinates.
inline double max_abs(const Vec3& a) {
    return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

inline double sum_of_sizes(const Vec3& a) {
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

inline double component(const Vec3& a, int axis) {
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/// A unit vector orthogonal to v; zero if v is zero.
inline Vec3 perpendicular(const Vec3& v) {
    const Vec3 size{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    return normalized_or_zero(cross(v, axis));
}

inline Vec3 min(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3 max(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

inline void extend(Box3& box, const Vec3& p) {
    box.lower = min(box.lower, p);
    box.upper = max(box.upper, p);
}
inline bool is_empty(const Box3& box) {
    return !(box.lower.x <= box.upper.x);
}
/// The box, enlarged by `margin` on every side.
inline Box3 grown(const Box3& box, double margin) {
    const Vec3 by{margin, margin, margin};
    return {box.lower - by, box.upper + by};
}
/// Whether the closed boxes are at most `gap` apart on every axis.
inline bool overlap(const Box3& a, const Box3& b, double gap = 0) {
    return a.lower.x - b.upper.x <= gap && b.lower.x - a.upper.x <= gap &&
           a.lower.y - b.upper.y <= gap && b.lower.y - a.upper.y <= gap &&
           a.lower.z - b.upper.z <= gap && b.lower.z - a.upper.z <= gap;
}
/// Whether `outer` encloses `inner`; shared boundaries count.
inline bool encloses(const Box3& outer, const Box3& inner) {
    return outer.lower.x <= inner.lower.x && inner.upper.x <= outer.upper.x &&
           outer.lower.y <= inner.lower.y && inner.upper.y <= outer.upper.y &&
           outer.lower.z <= inner.lower.z && inner.upper.z <= outer.upper.z;
}

} // namespace abut
