#pragma once

#include <abut/world.h>

#include "math/transform.h"
#include "math/vector.h"
#include "tests/support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// Signed distances of convex solids by brute force, in long double. The separation of two solids
/// along a unit vector n is how far the planes across n that touch them are apart. The largest
/// separation of all is the signed distance: the distance, or minus the depth.
namespace abut::test {

using Long = long double;

struct LongVec3 {
    Long x = 0, y = 0, z = 0;
};
inline LongVec3 to_long(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline LongVec3 operator+(const LongVec3& a, const LongVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LongVec3 operator-(const LongVec3& a, const LongVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LongVec3 operator*(Long s, const LongVec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Long dot(const LongVec3& a, const LongVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LongVec3 unit(const LongVec3& a) {
    return (1 / std::sqrt(dot(a, a))) * a;
}

/// A convex solid as a sum of simple parts: the hull of points, a disc across an axis, an ellipsoid
/// and a ball. A cone is the hull of its apex and the rest.
struct SolidParts {
    LongVec3 centre;
    std::array<LongVec3, 3> axis{LongVec3{1, 0, 0}, LongVec3{0, 1, 0}, LongVec3{0, 0, 1}};
    std::vector<LongVec3> points{{}}; ///< along the axes, relative to the centre
    Long disc = 0, ball = 0;
    std::array<Long, 3> semi_axes{};
    bool has_apex = false;
    Long apex = 0; ///< along axis[2]

    /// The largest coordinate of the solid along a unit vector, from `origin`.
    [[nodiscard]] Long farthest(const LongVec3& n, const LongVec3& origin) const {
        const Long x = dot(axis[0], n), y = dot(axis[1], n), z = dot(axis[2], n);
        Long most = -HUGE_VALL;
        for (const LongVec3& p : points)
            most = std::max(most, p.x * x + p.y * y + p.z * z);
        most += disc * std::sqrt(x * x + y * y);
        const Long p = semi_axes[0] * x, q = semi_axes[1] * y, r = semi_axes[2] * z;
        most += std::sqrt(p * p + q * q + r * r);
        if (has_apex)
            most = std::max(most, apex * z);
        return most + ball + dot(centre - origin, n);
    }
    void place(const Transform& world) {
        const auto& m = world.m;
        const auto turned = [&](const LongVec3& v) {
            return LongVec3{m[0] * v.x + m[3] * v.y + m[6] * v.z,
                            m[1] * v.x + m[4] * v.y + m[7] * v.z,
                            m[2] * v.x + m[5] * v.y + m[8] * v.z};
        };
        centre = turned(centre) + LongVec3{m[9], m[10], m[11]};
        for (LongVec3& each : axis)
            each = turned(each);
    }
    void point_axis_along(const Vec3& way) {
        const Vec3 z = normalized_or_zero(way);
        if (z == Vec3{})
            return;
        const LongVec3 along = unit(to_long(way)), x = unit(to_long(perpendicular(z)));
        const LongVec3 side = unit(x - dot(x, along) * along);
        axis = {side,
                LongVec3{along.y * side.z - along.z * side.y, along.z * side.x - along.x * side.z,
                         along.x * side.y - along.y * side.x},
                along};
    }
};

inline SolidParts parts_of(const Segment& axis, double ball) {
    SolidParts parts;
    parts.centre = 0.5L * (to_long(axis.a) + to_long(axis.b));
    parts.points = {to_long(axis.a) - parts.centre, to_long(axis.b) - parts.centre};
    parts.ball = ball;
    return parts;
}
inline SolidParts parts_of(const Sphere& sphere) {
    return parts_of(Segment{sphere.centre, sphere.centre}, sphere.radius);
}
inline SolidParts parts_of(const Capsule& capsule) {
    return parts_of(capsule.axis, capsule.radius);
}
inline SolidParts parts_of(const Cylinder& cylinder) {
    SolidParts parts = parts_of(cylinder.axis, 0);
    const LongVec3 half = to_long(cylinder.axis.b) - parts.centre;
    const Long length = std::sqrt(dot(half, half));
    parts.point_axis_along(cylinder.axis.b - cylinder.axis.a);
    parts.points = {{0, 0, -length}, {0, 0, length}};
    parts.disc = cylinder.radius;
    return parts;
}
inline SolidParts parts_of(const Cone& cone) {
    SolidParts parts = parts_of(Cylinder{{cone.base, cone.apex}, cone.radius});
    parts.has_apex = true, parts.apex = parts.points[1].z;
    parts.points = {parts.points[0]};
    return parts;
}
inline SolidParts parts_of(const Ellipsoid& ellipsoid) {
    SolidParts parts;
    parts.centre = to_long(ellipsoid.centre);
    const auto& [a, b, c] = ellipsoid.semi_axes;
    parts.semi_axes = {a, b, c};
    return parts;
}
inline SolidParts parts_of(const std::vector<Vec3>& points) {
    SolidParts parts;
    parts.points.clear();
    for (const Vec3& p : points)
        parts.points.push_back(to_long(p));
    return parts;
}
inline SolidParts parts_of(const Box3& box) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back({i % 2 == 0 ? box.lower.x : box.upper.x,
                           i / 2 % 2 == 0 ? box.lower.y : box.upper.y,
                           i / 4 == 0 ? box.lower.z : box.upper.z});
    return parts_of(corners);
}
inline SolidParts parts_of(const Convex& convex) {
    const auto vertices = convex.vertices();
    return parts_of(std::vector<Vec3>(vertices.begin(), vertices.end()));
}

/// Two solids in the world.
struct SolidPair {
    SolidParts a, b;

    [[nodiscard]] Long separation(const LongVec3& n) const {
        return -b.farthest(LongVec3{} - n, a.centre) - a.farthest(n, a.centre);
    }

    /// The largest separation that is found from many directions, of which the best are improved.
    [[nodiscard]] Long largest_separation(Random& random, const Vec3& guess) const {
        constexpr int kDirections = 200;
        constexpr std::size_t kBest = 4;
        std::vector<std::pair<Long, LongVec3>> tried;
        const auto look = [&](const LongVec3& n) { tried.emplace_back(separation(n), n); };
        look(unit(to_long(guess)));
        for (const SolidParts* parts : {&a, &b})
            for (const LongVec3& axis : parts->axis)
                look(axis), look(LongVec3{} - axis);
        const LongVec3 between = b.centre - a.centre;
        if (dot(between, between) > 0)
            look(unit(between)), look(unit(LongVec3{} - between));
        for (int i = 0; i < kDirections; ++i)
            look(to_long(random.direction()));
        std::partial_sort(tried.begin(), tried.begin() + kBest, tried.end(),
                          [](const auto& x, const auto& y) { return x.first > y.first; });
        Long most = -HUGE_VALL;
        for (std::size_t i = 0; i < kBest; ++i)
            most = std::max(most, improved(random, tried[i].second, tried[i].first));
        return most;
    }

private:
    /// Moves a direction by random steps, which become shorter where they do not help.
    [[nodiscard]] Long improved(Random& random, LongVec3 n, Long most) const {
        constexpr int kMostSteps = 800, kMisses = 10;
        Long step = 0.1L;
        int misses = 0;
        for (int i = 0; i < kMostSteps && step > 1e-9L; ++i) {
            const LongVec3 next = unit(n + step * to_long(random.direction()));
            const Long found = separation(next);
            if (found > most) {
                most = found, n = next, step *= 1.5L, misses = 0;
            } else if (++misses > kMisses) {
                step *= 0.5L, misses = 0;
            }
        }
        return most;
    }
};

} // namespace abut::test
