#include "walk/moving_probe.h"

#include "math/transform.h"
#include "rigid/motion/first_impact.h"
#include "rigid/motion/motion_bounds.h"
#include "rigid/shapes/shape_arguments.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// More than the rounding of a moved position, relative to the coordinates.
constexpr double kMovedRounding = 0x1p-44;

const Motion& checked(const Motion& motion) {
    require_point(motion.start.translation, "start of the motion");
    require_point(motion.velocity, "velocity of the motion");
    require_point(motion.centre, "centre of the motion");
    return motion;
}

} // namespace

MovingProbe::MovingProbe(const Probe& probe, const Transform& world_from_probe,
                         const Vec3& translation)
    : data_(probe.data()), start_(world_from_probe), placed_(probe, start_),
      trajectory_(start_, {}, translation, {}) {
    require_point(translation, "translation");
}

MovingProbe::MovingProbe(const Probe& probe, const Motion& motion)
    : data_(probe.data()), start_(checked(motion).start), placed_(probe, start_),
      trajectory_(motion) {}

std::vector<BoxMotion> MovingProbe::boxes(const PartTable& table) const {
    // A box per window covers the rotation within it.
    constexpr double kWindowTurn = 0.25;
    constexpr int kMostWindows = 32;
    std::vector<BoxMotion> boxes;
    if (is_empty(placed_.box()))
        return boxes;
    const double rate = trajectory_.speed_of_rotation();
    const int windows =
        static_cast<int>(std::clamp(std::ceil(rate / kWindowTurn), 1.0, double{kMostWindows}));
    const Vec3& velocity = trajectory_.velocity();
    const double reach = rate > 0 ? reach_from(data_.shape(), data_.own_bounds(),
                                               apply(inverse(start_), trajectory_.centre(0)))
                                  : 0;
    // A point moves by at most the arc of its rotation, and by at most the diameter.
    const double turned = std::min(rate / windows, 2.0) * reach;
    for (int i = 0; i < windows; ++i) {
        const double begin = double(i) / windows, end = double(i + 1) / windows;
        const Box3 box = bounds_of(data_.shape(), data_.own_bounds(), trajectory_.at(begin));
        const double size =
            max_abs(box.lower) + max_abs(box.upper) + max_abs(velocity) + turned + reach;
        const Box3 at_zero{box.lower - begin * velocity, box.upper - begin * velocity};
        boxes.push_back(
            {table.narrow(grown(at_zero, turned + kMovedRounding * size)), velocity, begin, end});
    }
    return boxes;
}

PartImpact MovingProbe::contact(const NearEntry& entry, double until, bool may_touch_at_start,
                                const WalkQuery& query, bool& meets) const {
    ImpactOptions options;
    options.absolute_error = query.absolute_error.value_or(
        kImpactTolerance * length(data_.own_bounds().upper - data_.own_bounds().lower));
    const Impact impact =
        first_impact({entry.model(), Trajectory(entry.world)}, {data_.surface(), trajectory_},
                     data_.radius(), until, options);
    PartImpact result;
    result.part = entry.part;
    meets = impact.meet;
    if (may_touch_at_start && data_.has_inside() && !(impact.meet && impact.time == 0)) {
        PairWarmStart warm_start;
        if (touch(entry.body(), placed_.body(), warm_start)) {
            const BodyGap gap =
                gap_between(entry.body(), placed_.body(), HUGE_VAL, Depths::no, warm_start);
            meets = true;
            result.time = result.contact_time = result.gap = 0;
            result.point_part = result.point_probe = gap.point_a;
            result.triangle_part = entry.triangle(gap.triangle_a);
            return result;
        }
    }
    if (!meets)
        return result;
    result.time = impact.time, result.contact_time = impact.contact_time, result.gap = impact.gap;
    result.point_part = impact.point_a;
    result.point_probe = impact.point_b - data_.radius() * impact.normal;
    result.normal = impact.normal;
    result.triangle_part = entry.triangle(impact.triangle_a);
    result.triangle_probe = impact.triangle_b;
    result.status = impact.status;
    return result;
}

} // namespace abut
