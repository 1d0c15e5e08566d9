#include "world/schedule/body_impact.h"

#include "math/transform.h"
#include "rigid/motion/impact_steps.h"
#include "rigid/motion/motion_bounds.h"
#include "world/narrow_phase/narrow_phase.h"
#include "world/schedule/deforming_impact.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Radius of a ball around the motion's centre, in the body's frame, that encloses the body.
double reach_of(const MovingBody& body) {
    const Transform start = body.motion.start;
    return reach_from(body.shape, body.own_bounds, apply(inverse(start), body.motion.centre));
}

/// Rounding error of a distance or a time, relative to the quantities it was computed from.
constexpr double kRounding = 0x1p-44;

class Advancement {
public:
    Advancement(const MovingBody& a, const MovingBody& b, const ImpactOptions& options)
        : a_(a), b_(b), options_(options), reach_a_(reach_of(a)), reach_b_(reach_of(b)),
          convex_(is_convex(a.shape) && is_convex(b.shape)) {
        const double size = std::max(reach_a_, reach_b_);
        scale_ = size + max_abs(a.motion.centre) + max_abs(b.motion.centre) +
                 max_abs(a.motion.velocity) + max_abs(b.motion.velocity);
        asked_tolerance_ = options.absolute_error.value_or(kImpactTolerance * size);
        tolerance_ = std::max(asked_tolerance_, 4 * kRounding * scale_);
    }

    Impact run() const {
        constexpr std::uint64_t kMostSteps = 1000;
        ImpactSteps steps(options_);
        Impact impact = search(steps, kMostSteps);
        impact.steps = steps.count();
        return impact;
    }

private:
    [[nodiscard]] Impact search(ImpactSteps& steps, std::uint64_t most_steps) const {
        double time = 0;
        BodyGap gap = gap_at(0);
        while (steps.count() < most_steps) {
            if (!steps.take(time))
                return out_of_steps(time);
            if (gap.distance <= tolerance_)
                return hit(time, gap);
            const double speed = closing_speed(gap);
            const double free = gap.distance - kRounding * scale_;
            if (speed <= 0 || time + free / speed > 1)
                return miss();
            // Stops short by half of the tolerance, so that the reported time is before contact.
            time += (free - 0.5 * tolerance_) / speed * (1 - kRounding);
            gap = gap_at(time);
        }
        Impact impact = hit(time, gap);
        impact.status = Status::bound_only;
        return impact;
    }

    [[nodiscard]] BodyGap gap_at(double time) const {
        const Transform world_a = at(a_.motion, time), world_b = at(b_.motion, time);
        PairWarmStart warm_start;
        return gap_between({a_.shape, world_a}, {b_.shape, world_b}, HUGE_VAL, Depths::no,
                           warm_start);
    }

    /// Upper bound of the speed at which points of the two bodies approach each other. For two
    /// convex bodies only the speed along the gap counts, since neither reaches beyond its plane
    /// across the gap.
    [[nodiscard]] double closing_speed(const BodyGap& gap) const {
        const Vec3 relative = a_.motion.velocity - b_.motion.velocity;
        const Vec3 &turn_a = a_.motion.angular_velocity, &turn_b = b_.motion.angular_velocity;
        const double speed =
            convex_ ? dot(relative, gap.normal) + reach_a_ * length(cross(turn_a, gap.normal)) +
                          reach_b_ * length(cross(turn_b, gap.normal))
                    : length(relative) + reach_a_ * length(turn_a) + reach_b_ * length(turn_b);
        return speed + kRounding * scale_;
    }

    [[nodiscard]] static Impact miss() { return {}; }

    [[nodiscard]] Impact hit(double time, const BodyGap& gap) const {
        Impact impact;
        impact.meet = true, impact.time = time, impact.gap = std::max(gap.distance, 0.0);
        impact.point_a = gap.point_a, impact.point_b = gap.point_b, impact.normal = gap.normal;
        impact.triangle_a = gap.triangle_a, impact.triangle_b = gap.triangle_b;
        impact.status = Status::bound_only;
        for (const double contact : {time, time_beyond(time, gap)})
            if (contact <= 1 && gap_at(contact).distance <= 0) {
                impact.contact_time = contact;
                impact.status = impact.gap <= asked_tolerance_ ? Status::exact : Status::converged;
                break;
            }
        return impact;
    }
    /// A time slightly after the gap may have closed.
    [[nodiscard]] double time_beyond(double time, const BodyGap& gap) const {
        const double speed = closing_speed(gap);
        return speed > 0 ? std::min(1.0, time + 2 * tolerance_ / speed) : 1;
    }

    const MovingBody &a_, &b_;
    const ImpactOptions& options_;
    double reach_a_, reach_b_;
    bool convex_;
    double scale_ = 0; ///< magnitude of the coordinates
    double asked_tolerance_ = 0, tolerance_ = 0;
};

const Model& model_of(const BodyShape& shape) {
    return std::get<Model>(shape);
}

} // namespace

Box3 swept_bounds(const MovingBody& body) {
    const Transform start = body.motion.start;
    const Box3 box = bounds_of(body.shape, body.own_bounds, start);
    if (is_empty(box))
        return box;
    if (is_deformable(body.shape)) // its box encloses the step except for rounding
        return grown(box, kRounding * (max_abs(box.lower) + max_abs(box.upper)));
    const double reach = reach_of(body);
    // A point moves by at most the arc of its rotation, and by at most the diameter of its sphere.
    const double turned = std::min(length(body.motion.angular_velocity), 2.0) * reach;
    const double by = turned + kRounding * (max_abs(box.lower) + max_abs(box.upper) + turned +
                                            max_abs(body.motion.velocity));
    const Vec3 margin{by, by, by}, &way = body.motion.velocity;
    return {min(box.lower, box.lower + way) - margin, max(box.upper, box.upper + way) + margin};
}

Impact body_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options) {
    if (is_deformable(a.shape) || is_deformable(b.shape))
        return deforming_impact(a, b, options);
    if (std::holds_alternative<Model>(a.shape) && std::holds_alternative<Model>(b.shape))
        return time_of_impact(model_of(a.shape), a.motion, model_of(b.shape), b.motion, options);
    return Advancement(a, b, options).run();
}

} // namespace abut
