#include "world/schedule/body_impact.h"

#include "convex/support/support_gap.h"
#include "math/transform.h"
#include "rigid/motion/impact_steps.h"
#include "rigid/motion/motion_bounds.h"
#include "world/narrow_phase/narrow_phase.h"
#include "world/narrow_phase/solid_gap.h"
#include "world/schedule/core_impact.h"
#include "world/schedule/deforming_impact.h"
#include "world/schedule/shared_point.h"
#include "world/schedule/turning_solids.h"
#include "world/schedule/turning_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace abut {

namespace {

/// Rounding error of a distance or a time, relative to the quantities it was computed from. Searches
/// with curved shapes end with a larger one.
constexpr double kRounding = 0x1p-44;
constexpr double kCurvedRounding = 0x1p-38;

bool is_curved(const MovingBody& body) {
    return std::holds_alternative<CurvedShape>(body.shape);
}

class Advancement {
public:
    static constexpr std::uint64_t kMostSteps = 1000, kMostOfCurved = 8192;

    Advancement(const MovingBody& a, const MovingBody& b, const ImpactOptions& options)
        : a_(a), b_(b), options_(options), reach_a_(reach_of(a)), reach_b_(reach_of(b)),
          swing_a_(core_reach_of(a)), swing_b_(core_reach_of(b)), plane_a_(is_half_space(a.shape)),
          plane_b_(is_half_space(b.shape)), is_any_curved_(is_curved(a) || is_curved(b)),
          turning_plane_((plane_a_ && turns(a)) || (plane_b_ && turns(b))),
          along_normal_(!turning_plane_ &&
                        (plane_a_ || plane_b_ || (is_convex(a.shape) && is_convex(b.shape)))) {
        const double plane_size = limit_planes();
        const double size = std::max(reach_a_, reach_b_);
        scale_ = size + max_abs(a.motion.centre) + max_abs(b.motion.centre) +
                 max_abs(a.motion.velocity) + max_abs(b.motion.velocity) + plane_size;
        // The smaller body's size; two half-spaces have none.
        const double own = plane_a_ && plane_b_ ? size : std::min(size_of(a), size_of(b));
        asked_tolerance_ = options.absolute_error.value_or(kImpactTolerance * own);
        error_ = (is_any_curved_ ? kCurvedRounding : kRounding) * scale_;
        tolerance_ = std::max(asked_tolerance_, 4 * error_);
    }

    Impact run() const {
        ImpactSteps steps(options_);
        Impact impact = search(steps, is_any_curved_ ? kMostOfCurved : kMostSteps);
        impact.steps = steps.count();
        return impact;
    }

    /// Looks for a contact after an impact of surfaces for which none was found. A surface that has gone
    /// into a solid at one instant shares points with the solid from then on, but none with its surface.
    void prove(Impact& impact) const {
        BodyGap gap;
        gap.distance = impact.gap, gap.normal = impact.normal;
        gap.point_a = impact.point_a, gap.point_b = impact.point_b;
        impact.contact_time = contact_after(impact.time, gap);
        if (impact.contact_time <= 1)
            impact.status = impact.gap <= asked_tolerance_ ? Status::exact : Status::converged;
    }

private:
    /// The bounds of second order cost more than a step. They are not asked where speeds alone prove this
    /// share of the time that is left.
    static constexpr double kLongStep = 8;

    /// A length that is free, and a bound of the speed at which it shrinks.
    struct Approach {
        double free = 0, speed = 0;
        [[nodiscard]] double time() const { return free / speed; }
    };

    /// Replaces the reach of a half-space by that of the part of its plane that the other body can
    /// be near. Returns a bound of the coordinates of the planes.
    double limit_planes() {
        if (!plane_a_ && !plane_b_)
            return 0;
        const double other = plane_a_ && plane_b_ ? 0 : plane_a_ ? reach_b_ : reach_a_;
        const double lever = std::min(farthest_centres(a_.motion, b_.motion) + other,
                                      plane_a_ ? lever_beside(b_, a_) : lever_beside(a_, b_));
        if (plane_a_)
            reach_a_ = swing_a_ = lever;
        if (plane_b_)
            reach_b_ = swing_b_ = lever;
        double size = lever;
        for (const MovingBody* body : {&a_, &b_})
            if (const auto* plane = std::get_if<PlaneShape>(&body->shape))
                size += max_abs(plane->point) + max_abs(body->motion.start.translation);
        return size;
    }

    [[nodiscard]] Impact search(ImpactSteps& steps, std::uint64_t most_steps) const {
        double time = 0, tolerance = tolerance_;
        BodyGap gap = gap_at(0);
        if (gap.distance <= 4 * error_) {
            time = free_from_start();
            if (time == 1)
                return miss();
            if (time > 0)
                gap = gap_at(time);
        }
        while (steps.count() < most_steps) {
            if (!steps.take(time))
                return out_of_steps(time);
            const double apart = along_normal_ ? gap_along_normal(time, gap) : 0;
            // A search for the distance of curved shapes may end before it is proven.
            const double proven =
                along_normal_ && is_any_curved_ ? std::min(gap.distance, apart) : gap.distance;
            if (proven <= tolerance) {
                const double contact = contact_after(time, gap);
                if (contact <= 1 || proven <= 4 * error_)
                    return hit(time, gap, contact);
                // They may pass each other. What follows shows it, or brings them nearer.
                tolerance = std::max(0.25 * proven, 4 * error_);
            }
            if (plane_a_ && plane_b_ && turning_plane_)
                break; // they meet far away
            const Approach fast{proven - error_, fastest_approach()};
            Approach best = fast;
            if (along_normal_) {
                const Approach along{apart - kRounding * scale_, closing_speed(gap)};
                if (along.free > 0 && along.speed <= 0)
                    return miss();
                if (along.free > 0 && along.time() > fast.time())
                    best = along;
            }
            if (time + best.time() > 1)
                return miss();
            // Stops short by half of the tolerance, so that the reported time is before contact.
            const double by_room =
                time_of_room(time, gap, fast.time(), 0.5 * tolerance + 2 * error_, 1 - time);
            if (time + by_room >= 1)
                return miss();
            best.free -= 0.5 * tolerance;
            time += std::max({best.time(), fast.time() - 0.5 * tolerance / fast.speed, by_room}) *
                    (1 - kRounding);
            gap = gap_at(time);
        }
        return hit(time, gap, contact_after(time, gap));
    }

    [[nodiscard]] BodyGap gap_at(double time, Depths depths = Depths::no) const {
        const Transform world_a = at(a_.motion, time), world_b = at(b_.motion, time);
        PairWarmStart warm_start;
        return gap_between({a_.shape, world_a}, {b_.shape, world_b}, HUGE_VAL, depths, warm_start);
    }

    /// The time up to which two convex bodies that touch at the start, to rounding, do not meet again: they
    /// part, or nothing but rounding brings them nearer along the normal. 0 if that is not proven, or if
    /// they overlap. The normal of so short a gap may be wrong; then the planes across it do not separate
    /// the bodies.
    [[nodiscard]] double free_from_start() const {
        if (!along_normal_)
            return 0;
        const BodyGap touching = gap_at(0, Depths::yes);
        if (-touching.distance > 4 * error_ || touching.normal == Vec3{} ||
            gap_along_normal(0, touching) < -4 * error_)
            return 0;
        if (closing_speed(touching) <= 2 * kRounding * scale_)
            return 1;
        const auto is_known = [](const MovingBody& body) {
            return is_half_space(body.shape) || is_convex(body.shape);
        };
        if (!is_known(a_) || !is_known(b_)) // a half-space and a surface
            return 0;
        constexpr double kShortest = 0x1p-12; // of the step; bodies that part more slowly touch
        double time = 1;
        const auto room_after = [&](double later) {
            return with_solids(0, [&](const TurningSolid& a, const TurningSolid& b) {
                return least_room_after(later, a, b, touching.normal);
            });
        };
        // Bodies that are apart by rounding may come nearer by rounding; others must stay apart.
        const double rounding = kRounding * scale_,
                     least =
                         std::clamp(2 * (room_after(0) - rounding), -2 * rounding, 2 * rounding);
        while (time >= kShortest && room_after(time) < least)
            time *= 0.5;
        return time >= kShortest ? time : 0;
    }

    /// A body as a solid at a time; a half-space as a point of its plane. None for a surface.
    [[nodiscard]] static std::optional<SupportShape> solid_at(const MovingBody& body, double time) {
        const Transform world = at(body.motion, time);
        if (const auto* plane = std::get_if<PlaneShape>(&body.shape)) {
            SupportShape point;
            point.centre = placed(*plane, world).point;
            return point;
        }
        return support_of(PlacedBody{body.shape, world});
    }
    [[nodiscard]] static TurningSolid turning(const MovingBody& body, const SupportShape& solid,
                                              double time, double swing) {
        const Motion& motion = body.motion;
        return {solid, motion.centre + time * motion.velocity, motion.velocity,
                motion.angular_velocity, swing};
    }
    /// Calls use(a, b) with both bodies as solids at a time. Returns 0 if one of them is none.
    template <typename Use>
    [[nodiscard]] double with_solids(double time, const Use& use) const {
        const auto solid_a = solid_at(a_, time), solid_b = solid_at(b_, time);
        return solid_a && solid_b ? use(turning(a_, *solid_a, time, swing_a_),
                                        turning(b_, *solid_b, time, swing_b_))
                                  : 0;
    }
    /// How long after a time more than a margin is left between the bodies, at most `horizon`: by a bound of
    /// the second order in time, which finds what speeds alone hide from large bodies that turn, and
    /// from surfaces.
    [[nodiscard]] double time_of_room(double time, const BodyGap& gap, double free, double margin,
                                      double horizon) const {
        const bool turn = turns(a_) || turns(b_);
        if (along_normal_ && turn)
            return with_solids(time, [&](const TurningSolid& a, const TurningSolid& b) {
                return time_with_room(a, b, gap.normal, margin, horizon);
            });
        const bool is_model_a = std::holds_alternative<Model>(a_.shape);
        const MovingBody &surface = is_model_a ? a_ : b_, &other = is_model_a ? b_ : a_;
        if (along_normal_ || !std::holds_alternative<Model>(surface.shape) ||
            is_half_space(other.shape) || kLongStep * free >= horizon)
            return 0;
        const auto solid = solid_at(other, time);
        if (!solid)
            return 0;
        const Motion& motion = surface.motion;
        const PlacedModel model(std::get<Model>(surface.shape), at(motion, time));
        return time_with_room({model, motion.centre + time * motion.velocity, motion.velocity,
                               motion.angular_velocity},
                              turning(other, *solid, time, is_model_a ? swing_b_ : swing_a_), free,
                              fastest_approach(), margin, horizon);
    }

    /// Upper bound of the speed at which points of the two bodies approach each other.
    [[nodiscard]] double fastest_approach() const {
        return length(a_.motion.velocity - b_.motion.velocity) + swing_a_ * turning_speed(a_) +
               swing_b_ * turning_speed(b_) + kRounding * scale_;
    }
    /// The same for points on planes across the normal of the gap.
    [[nodiscard]] double closing_speed(const BodyGap& gap) const {
        if (!along_normal_)
            return fastest_approach();
        return dot(a_.motion.velocity - b_.motion.velocity, gap.normal) +
               swing_a_ * length(cross(a_.motion.angular_velocity, gap.normal)) +
               swing_b_ * length(cross(b_.motion.angular_velocity, gap.normal)) +
               kRounding * scale_;
    }
    /// The distance of the planes across the normal of the gap that touch the bodies. It is less
    /// than the gap: the shorter the gap, the more rounding tilts its normal.
    [[nodiscard]] double gap_along_normal(double time, const BodyGap& gap) const {
        const Transform world_a = at(a_.motion, time), world_b = at(b_.motion, time);
        const auto solid_a = support_of(PlacedBody{a_.shape, world_a}),
                   solid_b = support_of(PlacedBody{b_.shape, world_b});
        return solid_a && solid_b ? separation_along(*solid_a, *solid_b, gap.normal)
                                  : gap.distance; // one is a half-space
    }

    [[nodiscard]] static Impact miss() { return {}; }

    /// In          contact: a time at which the bodies share a point; none: infinite.
    [[nodiscard]] Impact hit(double time, const BodyGap& gap, double contact) const {
        Impact impact;
        impact.meet = true, impact.time = time, impact.gap = std::max(gap.distance, 0.0);
        impact.point_a = gap.point_a, impact.point_b = gap.point_b, impact.normal = gap.normal;
        if (time == 0 && gap.distance <= 0) {
            impact.normal = {};
            const Transform world_a = at(a_.motion, 0), world_b = at(b_.motion, 0);
            impact.point_a = impact.point_b =
                shared_point({a_.shape, world_a}, {b_.shape, world_b}, gap);
        }
        impact.triangle_a = gap.triangle_a, impact.triangle_b = gap.triangle_b;
        impact.contact_time = contact;
        impact.status = contact > 1                      ? Status::bound_only
                        : impact.gap <= asked_tolerance_ ? Status::exact
                                                         : Status::converged;
        return impact;
    }

    /// A time at which the bodies share a point, soon after their gap has become short. Infinite if
    /// none is found.
    [[nodiscard]] double contact_after(double time, const BodyGap& gap) const {
        if (gap.distance <= 0)
            return time;
        // The present speed of the witness points predicts the time, unless they turn away.
        const double closing = dot(velocity_at(a_.motion, gap.point_a, time) -
                                       velocity_at(b_.motion, gap.point_b, time),
                                   gap.normal);
        double step = 0;
        if (closing > 0)
            for (const double part : {1.001, 1.1, 2.0, 8.0}) {
                step = (part * gap.distance + 2 * error_) / closing;
                if (is_contact(time + step))
                    return std::min(time + step, 1.0);
            }
        // No contact can be earlier than at the greatest speed. From there, times at twice the last
        // distance find every contact that lasts as long as it lets wait.
        for (step = std::max(step, gap.distance / fastest_approach()); step < 1; step *= 2)
            if (is_contact(time + step))
                return std::min(time + step, 1.0);
        return is_contact(1) ? 1 : std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] bool is_contact(double time) const {
        return gap_at(std::min(time, 1.0)).distance <= 0;
    }
    [[nodiscard]] static Vec3 velocity_at(const Motion& motion, const Vec3& point, double time) {
        return motion.velocity +
               cross(motion.angular_velocity, point - (motion.centre + time * motion.velocity));
    }

    const MovingBody &a_, &b_;
    const ImpactOptions& options_;
    double reach_a_, reach_b_;
    double swing_a_, swing_b_; ///< by how much turning may move the body's surface
    bool plane_a_, plane_b_, is_any_curved_, turning_plane_;
    bool along_normal_; ///< whether planes across the normal of a gap separate the bodies
    double scale_ = 0;  ///< magnitude of the coordinates
    double error_ = 0;  ///< of a distance
    double asked_tolerance_ = 0, tolerance_ = 0;
};

const Model& model_of(const BodyShape& shape) {
    return std::get<Model>(shape);
}

/// Whether a body's surface is known as triangles with a radius around them.
bool has_core(const MovingBody& body) {
    return std::holds_alternative<RoundedBox>(body.shape) ||
           std::holds_alternative<ConvexShape>(body.shape);
}

bool is_model(const MovingBody& body) {
    return std::holds_alternative<Model>(body.shape);
}

bool touch_at_start(const MovingBody& a, const MovingBody& b) {
    const Transform world_a = at(a.motion, 0), world_b = at(b.motion, 0);
    PairWarmStart warm_start;
    return touch({a.shape, world_a}, {b.shape, world_b}, warm_start);
}

/// In          not touching at the start.
Impact impact_of_cores(const MovingBody& a, const MovingBody& b, const ImpactOptions& options) {
    const double tolerance =
        options.absolute_error.value_or(kImpactTolerance * std::min(size_of(a), size_of(b)));
    Impact impact = core_impact(a, b, tolerance, options);
    if (impact.status == Status::bound_only && !impact.out_of_steps)
        Advancement(a, b, options).prove(impact);
    return impact;
}

} // namespace

Box3 swept_bounds(const MovingBody& body) {
    const Transform start = body.motion.start;
    const Box3 box = bounds_of(body.shape, body.own_bounds, start);
    if (is_empty(box))
        return box;
    if (is_half_space(body.shape)) {
        constexpr double kAll = std::numeric_limits<double>::infinity();
        if (turns(body))
            return {{-kAll, -kAll, -kAll}, {kAll, kAll, kAll}};
        const Vec3& way = body.motion.velocity;
        const double by = kRounding * (max_abs(body.motion.centre) + max_abs(way));
        return grown(Box3{min(box.lower, box.lower + way), max(box.upper, box.upper + way)}, by);
    }
    if (is_deformable(body.shape)) // its box encloses the step except for rounding
        return grown(box, kRounding * (max_abs(box.lower) + max_abs(box.upper)));
    const double reach = core_reach_of(body);
    // A point moves by at most the arc of its rotation, and by at most the diameter of its sphere.
    const double turned = std::min(length(body.motion.angular_velocity), 2.0) * reach;
    const double by = turned + kRounding * (max_abs(box.lower) + max_abs(box.upper) + turned +
                                            max_abs(body.motion.velocity));
    const Vec3 margin{by, by, by}, &way = body.motion.velocity;
    return {min(box.lower, box.lower + way) - margin, max(box.upper, box.upper + way) + margin};
}

Impact turned_round(Impact impact) {
    std::swap(impact.point_a, impact.point_b);
    std::swap(impact.triangle_a, impact.triangle_b);
    impact.normal = -impact.normal;
    return impact;
}

Impact body_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options) {
    if (is_deformable(a.shape) || is_deformable(b.shape))
        return deforming_impact(a, b, options);
    if (is_model(a) && is_model(b))
        return time_of_impact(model_of(a.shape), a.motion, model_of(b.shape), b.motion, options);
    if (((is_model(a) && has_core(b)) || (has_core(a) && is_model(b))) && !touch_at_start(a, b))
        return is_model(a) ? impact_of_cores(a, b, options)
                           : turned_round(impact_of_cores(b, a, options));
    const Impact impact = Advancement(a, b, options).run();
    if (impact.steps < Advancement::kMostSteps || impact.contact_time <= 1 || !has_core(a) ||
        !has_core(b))
        return impact;
    // Large bodies that turn beside small ones: planes that turn with them prove more at a time.
    ImpactOptions left = options;
    if (options.max_steps)
        left.max_steps = *options.max_steps - impact.steps;
    Impact of_cores = impact_of_cores(a, b, left);
    of_cores.steps += impact.steps;
    return of_cores;
}

} // namespace abut
