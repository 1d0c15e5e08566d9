#pragma once

#include <abut/curved_shapes.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"

#include <algorithm>
#include <cmath>

/// How far curved shapes reach along a direction, from their definitions.
namespace abut::test {

/// The largest dot product of a direction of unit length and a point of the shape, in its own frame.
struct ReachAlong {
    Vec3 direction;

    [[nodiscard]] double of_disc(const Vec3& middle, const Vec3& axis, double radius) const {
        const double along = dot(direction, axis) / length(axis);
        return dot(direction, middle) + radius * std::sqrt(std::max(0.0, 1 - along * along));
    }
    double operator()(const Cylinder& c) const {
        const Vec3 way = c.axis.b - c.axis.a;
        return std::max(of_disc(c.axis.a, way, c.radius), of_disc(c.axis.b, way, c.radius));
    }
    double operator()(const Cone& c) const {
        return std::max(dot(direction, c.apex), of_disc(c.base, c.apex - c.base, c.radius));
    }
    double operator()(const Ellipsoid& e) const {
        const Vec3 scaled{e.semi_axes.x * direction.x, e.semi_axes.y * direction.y,
                          e.semi_axes.z * direction.z};
        return dot(direction, e.centre) + length(scaled);
    }
    double operator()(const auto& /*other*/) const { return HUGE_VAL; }
};

/// How deep a curved shape under a pose is below a plane, whose normal of unit length points to the shape.
inline double depth_below(const Vec3& normal, const Vec3& on_plane, const AnyShape& shape,
                          const Pose& pose) {
    const Transform world = pose;
    const Vec3 place{world.m[9], world.m[10], world.m[11]};
    const Vec3 own = -pull_back(world, normal);
    return dot(normal, on_plane - place) + std::visit(ReachAlong{own}, shape);
}

} // namespace abut::test
