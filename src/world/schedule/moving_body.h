#pragma once

#include <abut/motion.h>

#include "math/transform.h"
#include "world/narrow_phase/narrow_phase.h"

#include <algorithm>
#include <limits>
#include <variant>

namespace abut {

/// A shape and its motion. A deformable moves by its own step, whatever `motion` says.
struct MovingBody {
    const BodyShape& shape;
    const Box3& own_bounds;
    const Motion& motion;
};

/// Radius of a ball around the motion's centre, in the body's frame, that encloses the body.
inline double reach_of(const MovingBody& body) {
    const Transform start = body.motion.start;
    return reach_from(body.shape, body.own_bounds, apply(inverse(start), body.motion.centre));
}

/// Half of the body's extent, whatever it turns about. Infinite for a half-space.
inline double size_of(const MovingBody& body) {
    const Box3& box = body.own_bounds;
    return reach_from(body.shape, box, 0.5 * box.lower + 0.5 * box.upper);
}

/// As `reach_of`, for points of the body's core, if it is one that a ball moves along: turning about a point of
/// the core moves no surface by more than it moves the core.
inline double core_reach_of(const MovingBody& body) {
    const auto* box = std::get_if<RoundedBox>(&body.shape);
    return box != nullptr ? std::max(0.0, reach_of(body) - box->radius) : reach_of(body);
}

inline bool turns(const MovingBody& body) {
    return body.motion.angular_velocity != Vec3{};
}

/// The largest distance of the two motions' centres, which is at the start or at the end.
inline double farthest_centres(const Motion& a, const Motion& b) {
    const Vec3 start = b.centre - a.centre;
    return std::max(length(start), length(start + b.velocity - a.velocity));
}

/// Bounds the distance of a body's points from the centre about which a half-space turns.
inline double lever_beside(const MovingBody& body, const MovingBody& plane) {
    if (is_half_space(body.shape))
        return std::numeric_limits<double>::infinity();
    const Vec3 middle = 0.5 * body.own_bounds.lower + 0.5 * body.own_bounds.upper;
    return length(apply(at(body.motion, 0), middle) - plane.motion.centre) + size_of(body) +
           length(body.motion.velocity - plane.motion.velocity) +
           length(body.motion.angular_velocity) * reach_of(body);
}

/// Bounds the speed, over a lever, at which turning brings points nearer. A half-space that turns about its
/// normal stays in place.
inline double turning_speed(const MovingBody& body) {
    const Vec3& w = body.motion.angular_velocity;
    const auto* plane = std::get_if<PlaneShape>(&body.shape);
    return length(plane == nullptr ? w : cross(w, placed(*plane, at(body.motion, 0)).normal));
}

} // namespace abut
