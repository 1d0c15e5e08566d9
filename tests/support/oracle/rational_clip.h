#pragma once

#include "math/transform.h"
#include "math/vector.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

/// Decides whether a triangle meets a convex solid, by clipping it against the solid's half-spaces
/// in rational numbers.
namespace abut::test {

using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                               boost::multiprecision::et_off>;

struct RationalVec3 {
    Rational x, y, z;
    RationalVec3(Rational a, Rational b, Rational c)
        : x(std::move(a)), y(std::move(b)), z(std::move(c)) {}
    explicit RationalVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};
inline RationalVec3 operator-(const RationalVec3& a, const RationalVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Rational dot(const RationalVec3& a, const RationalVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline RationalVec3 cross(const RationalVec3& a, const RationalVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The half-space normal . x <= offset.
struct RationalPlane {
    RationalVec3 normal;
    Rational offset;
};

inline std::vector<RationalPlane> rational_planes(const Box3& box) {
    std::vector<RationalPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 unit{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
        planes.push_back({RationalVec3(unit), Rational(component(box.upper, axis))});
        planes.push_back({RationalVec3(-unit), Rational(-component(box.lower, axis))});
    }
    return planes;
}

/// The half-spaces of a box under a regular transform. In: the transformed corners are exact.
inline std::vector<RationalPlane> rational_planes(const Box3& box, const Transform& world) {
    const RationalVec3 low(apply(world, box.lower)), high(apply(world, box.upper));
    const std::array axes{RationalVec3(apply_linear(world, {1, 0, 0})),
                          RationalVec3(apply_linear(world, {0, 1, 0})),
                          RationalVec3(apply_linear(world, {0, 0, 1}))};
    std::vector<RationalPlane> planes;
    for (std::size_t k = 0; k < 3; ++k) {
        RationalVec3 n = cross(axes[(k + 1) % 3], axes[(k + 2) % 3]);
        if (dot(n, axes[k]) < 0)
            n = {-n.x, -n.y, -n.z};
        planes.push_back({n, dot(n, high)});
        planes.push_back({{-n.x, -n.y, -n.z}, -dot(n, low)});
    }
    return planes;
}

/// The part of a triangle within closed half-spaces: a convex polygon, which may repeat corners.
/// Source      [Sutherland, Hodgman 1974].
inline std::vector<RationalVec3> clipped(const Triangle& t,
                                         const std::vector<RationalPlane>& planes) {
    std::vector<RationalVec3> polygon{RationalVec3(t[0]), RationalVec3(t[1]), RationalVec3(t[2])};
    for (const RationalPlane& plane : planes) {
        std::vector<RationalVec3> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const RationalVec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const Rational over_p = dot(plane.normal, p) - plane.offset,
                           over_q = dot(plane.normal, q) - plane.offset;
            if (over_p <= 0)
                kept.push_back(p);
            if (over_p.sign() * over_q.sign() < 0) {
                const Rational s = over_p / (over_p - over_q);
                kept.push_back(
                    {p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.z + s * (q.z - p.z)});
            }
        }
        polygon = std::move(kept);
    }
    return polygon;
}

inline bool clip_meets(const Triangle& t, const std::vector<RationalPlane>& planes) {
    return !clipped(t, planes).empty();
}

/// Whether a triangle meets the interior. The centre of the clipped polygon lies on a plane only if
/// the whole polygon does.
inline bool clip_enters(const Triangle& t, const std::vector<RationalPlane>& planes) {
    const std::vector<RationalVec3> polygon = clipped(t, planes);
    RationalVec3 sum({}, {}, {});
    for (const RationalVec3& p : polygon)
        sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    const Rational count = static_cast<double>(polygon.size());
    for (const RationalPlane& plane : planes)
        if (polygon.empty() || dot(plane.normal, sum) >= count * plane.offset)
            return false;
    return true;
}

} // namespace abut::test
