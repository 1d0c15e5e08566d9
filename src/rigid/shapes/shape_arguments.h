#pragma once

#include <abut/error.h>
#include <abut/shapes.h>

#include "core/arguments.h"
#include "math/vector.h"
#include "mesh/topology.h"

#include <cmath>
#include <cstddef>
#include <string>

/// Checks of the arguments of queries with shapes. Errors: Error{bad_argument}.
namespace abut {

/// How many points or rays of a list one task takes.
inline constexpr std::size_t kShapesPerTask = 64;

/// Requires coordinates in the range that a mesh allows.
inline void require_point(const Vec3& p, const char* what) {
    const bool in_range =
        std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kLargestCoordinate;
    if (is_finite(p) && in_range)
        return;
    require(is_finite(p), std::string(what) + " has a coordinate that is not finite");
    require(in_range, std::string(what) + " has a coordinate beyond 1e18");
}

inline void require_bound(double bound) {
    require_not_negative(bound, "distance bound");
}

inline void require_ray(const Ray& ray) {
    require_point(ray.origin, "origin of the ray");
    require(is_finite(ray.direction), "direction of the ray is not finite");
    require(ray.direction != Vec3{}, "direction of the ray is zero");
    require(!std::isnan(ray.t_min) && !std::isnan(ray.t_max), "range of the ray is not a number");
}

inline void require_segment(const Segment& segment) {
    require_point(segment.a, "segment");
    require_point(segment.b, "segment");
}

inline void require_sphere(const Sphere& sphere) {
    require_point(sphere.centre, "centre of the sphere");
    require(sphere.radius >= 0 && sphere.radius <= kLargestCoordinate,
            "radius of the sphere must not be negative, nor beyond 1e18");
}

/// Returns false if the box is empty.
inline bool require_box(const Box3& box) {
    if (box.lower.x > box.upper.x || box.lower.y > box.upper.y || box.lower.z > box.upper.z)
        return false;
    require_point(box.lower, "box");
    require_point(box.upper, "box");
    return true;
}

} // namespace abut
