#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <optional>

/// When do two moving rigid models first meet? docs/time-of-impact.md tells how it is found.
namespace abut {

/// How a rigid body moves while t goes from 0 to 1: it turns about a centre at constant angular
/// velocity w, while the centre moves in a straight line at constant velocity v.
///
///     x(0) = R(start.rotation) p + start.translation
///     x(t) = x(0) + t v + (Rot(t w) - I) (x(0) - centre)
///
/// A screw motion is the case of a centre on the screw's axis and a velocity along it.
struct Motion {
    Pose start;
    Vec3 centre;           ///< world point at t = 0
    Vec3 velocity;         ///< of the centre; lengths per unit of t
    Vec3 angular_velocity; ///< world axis, its length in radians per unit of t

    /// No motion.
    static Motion fixed(const Pose& pose);

    /// The point `about` of the body (in its own frame) moves from its place in `start` to that in
    /// `end` in a straight line, and the body turns about it along the shortest arc.
    ///
    /// Degenerate  of two arcs of half a turn, one.
    /// Accuracy    t = 1 gives `end` to rounding.
    /// Errors      Error{bad_argument} if a value is not finite or a quaternion has zero length.
    static Motion between(const Pose& start, const Pose& end, const Vec3& about = {});

    /// Along the one screw that takes `start` to `end`, by the shortest arc, at constant rate. Does
    /// not depend on the body's frame.
    ///
    /// Degenerate  without rotation: the straight line.
    /// Accuracy, Errors as `between`.
    static Motion screw(const Pose& start, const Pose& end);
};

/// Where the motion has taken the body at time t: what every claim about a time refers to.
///
/// In          any finite t; [0, 1] is what `time_of_impact` looks at.
/// Accuracy    t = 0 gives the start exactly, a motion without rotation keeps the start's linear
///             part; else within some roundings of the formula above.
/// Errors      Error{bad_argument} if a value is not finite or the quaternion has zero length.
Transform at(const Motion& motion, double t);

struct ImpactOptions {
    /// Length. At the time returned, the models are at most this far apart. None given: a
    /// millionth of the diagonal of the larger model's bounding box. It decides how close below the
    /// first contact the time is, not whether there is one. Where rounding of the coordinates
    /// leaves more, the status is `converged`.
    std::optional<double> absolute_error{};
    /// At most so many steps: in each, a pair of boxes is opened or a pair of triangles is
    /// measured. A search that needs more answers what it has proven, see Impact::out_of_steps.
    /// None given: no limit.
    std::optional<std::uint64_t> max_steps{};
    /// Reports the share of the time that is proven free.
    Progress progress{};
};

struct Impact {
    bool meet = false;
    /// In [0, 1]. Never later than the first contact: up to here the way is free. 0: the models are
    /// in contact at the start. 1 where there is no hit.
    double time = 1;
    /// A time at which they are in contact as `collide` sees it, and so never earlier than the
    /// first contact. Infinite if none was found (status `bound_only`, or no hit).
    double contact_time = std::numeric_limits<double>::infinity();
    /// Between the two triangles at `time`: the models are at most this far apart.
    double gap = std::numeric_limits<double>::infinity();
    Vec3 point_a, point_b; ///< closest points of these triangles at `time`, world frame
    Vec3 normal;           ///< unit vector from a to b there; zero if they meet at the start
    std::uint32_t triangle_a = 0, triangle_b = 0;
    /// exact: the hit is proven (`contact_time`), or that there is none. converged: the hit is
    /// proven, and `gap` exceeds the tolerance, which is less than rounding leaves of the
    /// coordinates. bound_only: whether the models touch was not decided: they come as near as
    /// `gap` at `time`, and graze each other within rounding or slide along each other nearer than
    /// the tolerance for a long time; or the search ran out of steps. A hit is reported, to be
    /// safe.
    Status status = Status::exact;
    /// The search ended because of ImpactOptions::max_steps. The motion is free up to `time`, and
    /// nothing is known of what comes after: `gap` is infinite, points and triangles are zero.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see ImpactOptions::max_steps
    Counters counters;
};

/// The first time at which the surfaces of two moving models share a point.
///
/// In/out      a time within [0, 1]; models that pass each other, however near, are no hit unless
///             rounding or the search's limit leaves it open (see Impact::status).
/// Degenerate  models without thickness and zero-area triangles are met like any others, at any
///             speed; an empty model meets nothing.
/// Accuracy    never later than the first contact and never missing one, for the motion in real
///             arithmetic as well as for the positions of `at`; the gap left is at most the
///             tolerance, unless the status tells otherwise.
/// Errors      Error{bad_argument} if a value is not finite, a quaternion has zero length, the
///             tolerance is negative or NaN, or coordinates or speeds exceed 1e100.
///             Error{interrupted} if the stop flag is set.
/// Cost        one traversal of both trees in the order of time, as a `distance`, for each quarter
///             of a radian that both turn. The steps that a pair of triangles takes grow with the
///             logarithm of its size over the tolerance, unless it slides along a gap for long.
/// Source      conservative advancement [Mirtich 1996; Zhang, Redon, Lee, Kim 2006; Tang, Kim,
///             Manocha 2009]. Differs: every pair of nodes advances on its own, the pair of
///             earliest possible contact first; bounds are of second order in time, along planes
///             that turn with a body or stay parallel to two edges.
Impact time_of_impact(const Model& a, const Motion& motion_a, const Model& b,
                      const Motion& motion_b, const ImpactOptions& options = {});

} // namespace abut
