#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <optional>

/// Finds when two moving rigid models first meet. docs/time-of-impact.md explains the algorithm.
namespace abut {

/// The motion of a rigid body while t goes from 0 to 1. The body rotates about a centre at constant
/// angular velocity w, while the centre moves in a straight line at constant velocity v:
///
///     x(0) = R(start.rotation) p + start.translation
///     x(t) = x(0) + t v + (Rot(t w) - I) (x(0) - centre)
///
/// A screw motion has its centre on the screw's axis and its velocity along that axis.
struct Motion {
    Pose start;
    Vec3 centre;           ///< world point at t = 0
    Vec3 velocity;         ///< of the centre; length per unit of t
    Vec3 angular_velocity; ///< world axis, whose length is in radians per unit of t

    /// A body at rest.
    static Motion fixed(const Pose& pose);

    /// The point `about`, in the body's own frame, moves in a straight line from its place in
    /// `start` to its place in `end`. The body rotates about it along the shortest arc.
    ///
    /// Degenerate  for half a turn, one of the two shortest arcs.
    /// Accuracy    t = 1 gives `end` to rounding.
    /// Errors      Error{bad_argument} if a value is not finite or a quaternion has zero length.
    static Motion between(const Pose& start, const Pose& end, const Vec3& about = {});

    /// The one screw motion that takes `start` to `end` by the shortest arc at a constant rate. It
    /// does not depend on the body's frame.
    ///
    /// Degenerate  without rotation: the straight line.
    /// Accuracy, Errors as `between`.
    static Motion screw(const Pose& start, const Pose& end);
};

/// Returns the transform of the body at time t. All claims about a time refer to it.
///
/// In          any finite t; `time_of_impact` uses [0, 1].
/// Accuracy    t = 0 gives the start exactly, and a motion without rotation keeps the start's
///             linear part. Otherwise the error is a few roundings of the formula above.
/// Errors      Error{bad_argument} if a value is not finite or the quaternion has zero length.
Transform at(const Motion& motion, double t);

struct ImpactOptions {
    /// Length. At the returned time the models are at most this far apart. Default: a millionth of
    /// the diagonal of the smaller model's bounding box. It sets how close to the first contact the
    /// time is, not whether there is a contact. Where rounding of the coordinates leaves a larger
    /// gap, the status is `converged`.
    std::optional<double> absolute_error{};
    /// Maximum number of steps; none given: no limit. A step opens a pair of boxes or measures a
    /// pair of triangles. A search that needs more steps returns what it has proven so far, see
    /// Impact::out_of_steps.
    std::optional<std::uint64_t> max_steps{};
    /// Reports the fraction of the time that is proven free.
    Progress progress{};
};

struct Impact {
    bool meet = false;
    /// In [0, 1]. Never later than the first contact: the motion is free up to this time. 0: the
    /// models are in contact at the start, or so near it that no time is proven free. 1: they do not
    /// meet.
    double time = 1;
    /// A time at which `collide` finds the models in contact; it is never earlier than the first
    /// contact. Infinite if none was found (status `bound_only`, or the models do not meet).
    double contact_time = std::numeric_limits<double>::infinity();
    /// Distance of the two triangles at `time`: the models are at most this far apart.
    double gap = std::numeric_limits<double>::infinity();
    Vec3 point_a, point_b; ///< closest points of these triangles at `time`, world frame
    Vec3 normal;           ///< unit vector from a to b there; zero if the models meet at the start
    std::uint32_t triangle_a = 0, triangle_b = 0;
    /// exact: the contact (`contact_time`), or that there is none, is proven. converged: the
    /// contact is proven, but `gap` exceeds absolute_error, which is finer than the rounding of the
    /// coordinates. bound_only: whether the models touch was not decided, and `meet` is true, to be
    /// safe. Either they come as near as `gap` at `time`, and then graze each other within rounding
    /// or slide along each other within absolute_error for a long time; or the search ran out of
    /// steps.
    Status status = Status::exact;
    /// The search ended because of ImpactOptions::max_steps. The motion is free up to `time`;
    /// nothing is known about later times. `gap` is infinite; points and triangles are zero.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see ImpactOptions::max_steps
    Counters counters;
};

/// Finds the first time at which the surfaces of two moving models share a point.
///
/// In/out      a time in [0, 1]. Models that pass each other, however near, do not meet, unless
///             rounding or the limit of steps leaves it undecided (see Impact::status).
/// Degenerate  models without thickness and zero-area triangles are handled like all others, at any
///             speed. An empty model meets nothing.
/// Accuracy    the time is never later than the first contact, and no contact is missed. This holds
///             for the motion in real arithmetic and for the positions that `at` gives. The
///             remaining gap is at most absolute_error, unless the status says otherwise.
/// Errors      Error{bad_argument} if a value is not finite, a quaternion has zero length,
///             absolute_error is negative or NaN, or coordinates or speeds exceed 1e100.
///             Error{interrupted} if the stop flag is set.
/// Cost        one traversal of both trees in the order of time, similar to `distance`, for each
///             quarter of a radian that both bodies rotate. The steps for a pair of triangles grow
///             with the logarithm of its size over absolute_error, unless the pair slides along a
///             gap for long.
/// Source      conservative advancement [Mirtich 1996; Zhang, Redon, Lee, Kim 2006; Tang, Kim,
///             Manocha 2009]. Differs: every pair of nodes advances on its own, the pair with the
///             earliest possible contact first. Bounds are of second order in time, along planes
///             that rotate with a body or stay parallel to two edges.
Impact time_of_impact(const Model& a, const Motion& motion_a, const Model& b,
                      const Motion& motion_b, const ImpactOptions& options = {});

} // namespace abut
