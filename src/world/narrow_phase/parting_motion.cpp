#include "world/narrow_phase/parting_motion.h"

#include "convex/support/support_gap.h"
#include "geometry/point_triangle_distance.h"
#include "world/narrow_phase/solid_gap.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <limits>

namespace abut {

namespace {

struct MetTriangle {
    Triangle corners;
    std::uint32_t number;
};
using MetTriangles = boost::container::static_vector<MetTriangle, 64>;

/// Bounds the rounding of a height over a solid's lowest point.
double rounding_of(const SupportShape& solid) {
    return 0x1p-48 * (max_abs(solid.centre) + solid.reach + solid.radius);
}

/// The triangles at most a distance from the solid; none if there are too many.
MetTriangles triangles_met(const PlacedModel& model, const SupportShape& solid, double touching) {
    MetTriangles met;
    bool too_many = false;
    Vec3 direction;
    model.for_each_overlap(grown(box_around(solid), touching), [&](std::uint32_t slot) {
        const Triangle t = model.world_slot(slot);
        if (too_many ||
            support_gap(support_of(t), solid, touching, SupportDepths::no, direction).distance >
                touching)
            return;
        too_many = met.size() == met.capacity();
        if (!too_many)
            met.push_back({t, model.data().triangle_at(slot)});
    });
    if (too_many)
        met.clear();
    // The result must not depend on the tree.
    std::ranges::sort(met, {}, &MetTriangle::number);
    return met;
}

/// The motion along a direction that parts the solid from all triangles.
PartingMotion motion_along(const Vec3& direction, const MetTriangles& met,
                           const SupportShape& solid) {
    const Vec3 lowest = farthest(solid, -direction) - solid.radius * direction;
    PartingMotion motion{direction, 0, solid.centre + lowest, 0};
    for (const MetTriangle& each : met)
        for (const Vec3& corner : each.corners)
            if (const double height =
                    dot(direction, corner - solid.centre) - dot(direction, lowest);
                height > motion.length)
                motion.length = height;
    return motion;
}

/// The part of a motion after which the solid touches a triangle; its points are those that touch then. A
/// solid that reaches over the border of a surface has its lowest point beyond it.
std::optional<PartingMotion> ending_in_touch(PartingMotion motion, const MetTriangles& met,
                                             const SupportShape& solid, double touching) {
    constexpr int kMostRounds = 32;
    Vec3 guess;
    for (int round = 0; round < kMostRounds; ++round) {
        SupportShape moved = solid;
        moved.centre = solid.centre + motion.length * motion.direction;
        double back = motion.length;
        for (const MetTriangle& each : met) {
            const SupportGap gap =
                support_gap(support_of(each.corners), moved,
                            std::numeric_limits<double>::infinity(), SupportDepths::no, guess);
            if (gap.distance <= touching) {
                motion.point = gap.point_b - motion.length * motion.direction;
                motion.triangle = each.number;
                return motion;
            }
            // The planes across the gap stay apart on so much of the way back.
            if (const double closing = dot(motion.direction, gap.normal); closing > 0)
                back = std::min(back, gap.distance / closing);
        }
        motion.length -= back;
    }
    return std::nullopt;
}

} // namespace

std::optional<PartingMotion> find_parting_motion(const PlacedModel& model,
                                                 const SupportShape& solid,
                                                 const PartingMotion& known, double touching) {
    const MetTriangles met = triangles_met(model, solid, touching);
    if (met.empty())
        return std::nullopt;
    std::optional<PartingMotion> best;
    const auto try_along = [&](const Vec3& direction, double shorter_by) {
        if (direction == Vec3{})
            return;
        const PartingMotion motion = motion_along(direction, met, solid);
        if (!best || motion.length < best->length - shorter_by)
            best = motion;
    };
    Vec3 over; // the mean normal: the way out at an edge or a corner
    for (const MetTriangle& each : met) {
        const Triangle& t = each.corners;
        const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        try_along(normal, 0), try_along(-normal, 0);
        over = over + normal;
    }
    // Across a face is told where that parts them as well.
    const double rounding = rounding_of(solid);
    try_along(normalized_or_zero(over), rounding), try_along(-normalized_or_zero(over), rounding);
    try_along(known.direction, rounding);
    constexpr double kSame = 1 + 0x1p-30;
    const bool is_known = best && best->direction == known.direction;
    if (best) { // a witness point must lie on the surface
        const Vec3 opposite = best->point + best->length * best->direction;
        const auto holds_it = [&](const MetTriangle& each) {
            return point_triangle_distance(opposite, each.corners).distance_sq <=
                   touching * touching;
        };
        if (const auto found = std::ranges::find_if(met, holds_it); found != met.end())
            best->triangle = found->number;
        else
            best = ending_in_touch(*best, met, solid, touching);
    }
    return is_known && best && best->length <= known.length * kSame + rounding ? std::nullopt
                                                                               : best;
}

} // namespace abut
