#pragma once

#include <abut/vector.h>

#include <cmath>

/// The vector algebra that scenes need, and the grid on which their coordinates lie.
namespace abut::scenes {

constexpr Vec3 add(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 subtract(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 scaled(const Vec3& a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}
inline Vec3 unit(const Vec3& a) {
    return scaled(a, 1 / norm(a));
}
constexpr Vec3 mixed(const Vec3& a, const Vec3& b, double t) {
    return add(scaled(a, 1 - t), scaled(b, t));
}

inline constexpr Vec3 kX{1, 0, 0};
inline constexpr Vec3 kY{0, 1, 0};
inline constexpr Vec3 kZ{0, 0, 1};

/// Positions of parts are multiples of this, so that they and their sums are exact as floats.
inline constexpr double kGrid = 1.0 / 1024;
inline double on_grid(double v) {
    return std::floor(v / kGrid + 0.5) * kGrid;
}
inline double on_grid_above(double v) {
    return std::ceil(v / kGrid) * kGrid;
}

/// A translation.
inline Transform at(const Vec3& origin) {
    return Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, origin.x, origin.y, origin.z});
}

/// Maps the mesh's x and y axes to the given orthogonal unit vectors, and its origin to `origin`.
inline Transform turned(const Vec3& x, const Vec3& y, const Vec3& origin) {
    const Vec3 z = cross(x, y);
    return Transform({x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, origin.x, origin.y, origin.z});
}

/// Maps the mesh's x axis, along which members and pipes lie, to `direction`, a signed axis.
inline Transform along(const Vec3& direction, const Vec3& origin) {
    if (direction.y != 0) {
        return turned(direction, {-direction.y, 0, 0}, origin);
    }
    return turned(direction, kY, origin);
}

inline Vec3 apply(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

inline Vec3 turn(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

/// Applies `inner` first, then `outer`.
inline Transform after(const Transform& outer, const Transform& inner) {
    const auto& m = inner.m;
    const Vec3 x = turn(outer, {m[0], m[1], m[2]});
    const Vec3 y = turn(outer, {m[3], m[4], m[5]});
    const Vec3 z = turn(outer, {m[6], m[7], m[8]});
    const Vec3 o = apply(outer, {m[9], m[10], m[11]});
    return Transform({x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, o.x, o.y, o.z});
}

inline void extend(Box3& box, const Vec3& p) {
    box.lower = {std::fmin(box.lower.x, p.x), std::fmin(box.lower.y, p.y),
                 std::fmin(box.lower.z, p.z)};
    box.upper = {std::fmax(box.upper.x, p.x), std::fmax(box.upper.y, p.y),
                 std::fmax(box.upper.z, p.z)};
}

/// The axis-aligned box of a box's eight moved corners.
inline Box3 moved(const Transform& t, const Box3& box) {
    Box3 result;
    for (int corner = 0; corner < 8; ++corner) {
        extend(result, apply(t, {(corner & 1) != 0 ? box.upper.x : box.lower.x,
                                 (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                 (corner & 4) != 0 ? box.upper.z : box.lower.z}));
    }
    return result;
}

} // namespace abut::scenes
