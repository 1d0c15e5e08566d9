#include "world/narrow_phase/model_gap.h"

#include <abut/rigid.h>

#include "math/vector.h"
#include "rigid/manifold/touching_direction.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

BodyGap from_rigid(const Gap& gap, const Vec3& normal) {
    return {{},          {},     gap.distance,   gap.point_a,
            gap.point_b, normal, gap.triangle_a, gap.triangle_b,
            gap.status};
}

} // namespace

BodyGap model_gap(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, double upper_bound, Depths depths,
                  WarmStart& warm_start) {
    DistanceOptions options;
    options.upper_bound = std::max(upper_bound, 0.0);
    options.signed_distance = depths == Depths::yes;
    options.warm_start = &warm_start;
    const Gap found = distance(a, world_from_a, b, world_from_b, options);
    // If the models overlap, moving b along the normal brings its point to a's point.
    const Vec3 between = found.point_b - found.point_a,
               way = found.distance < 0 ? -between : between;
    BodyGap gap = from_rigid(found, normalized_or_zero(way));
    const bool has_points = found.distance <= options.upper_bound;
    if (has_points && (found.distance > 0 || depths == Depths::yes))
        if (const auto normal =
                direction_of_touching(a, world_from_a, b, world_from_b, found.point_a,
                                      found.point_b, way, std::abs(found.distance)))
            gap.normal = *normal;
    // The depth of a point in a solid is a bound of the length of a separating motion, however
    // exact it is.
    if (gap.distance < 0)
        gap.status = Status::bound_only;
    return gap;
}

} // namespace abut
