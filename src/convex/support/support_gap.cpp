#include "convex/support/support_gap.h"

#include "convex/support/support_depth.h"
#include "convex/support/support_distance.h"

#include <algorithm>

namespace abut {

SupportGap support_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                       SupportDepths depths, Vec3& direction) {
    const SupportPair pair(a, b);
    const double to_world = 1 / pair.factor();
    SupportSearch search;
    search.first = direction;
    search.apart = pair.factor() * std::max(upper_bound, 0.0) + pair.radii() + pair.rounding();
    const SupportDistance found = support_distance(pair, search);
    SupportGap gap;
    DifferencePoint points;
    if (found.meet && depths == SupportDepths::no) {
        points = found.simplex.nearest();
    } else if (found.meet) {
        const SupportDepth depth = support_depth(pair, found.simplex);
        const double allowed = 4 * std::max(kDepthTolerance, 2 * pair.rounding());
        gap.bounds_agree = depth.depth - depth.at_least <= allowed;
        gap.distance = gap.bounds_agree ? -depth.depth : -depth.at_least;
        gap.normal = depth.normal;
        points.a = depth.point_a, points.b = depth.point_b;
    } else {
        gap.distance = found.distance;
        gap.normal = (1 / found.distance) * found.direction;
        points = found.simplex.nearest();
    }
    if (gap.normal != Vec3{})
        direction = gap.normal;
    gap.distance = to_world * (gap.distance - pair.radii());
    gap.point_a = a.centre + to_world * points.a + a.radius * gap.normal;
    gap.point_b = a.centre + to_world * points.b - b.radius * gap.normal;
    return gap;
}

bool supports_meet(const SupportShape& a, const SupportShape& b, Vec3& direction) {
    const SupportPair pair(a, b);
    SupportSearch search;
    search.first = direction;
    search.apart = search.near = pair.radii();
    const SupportDistance found = support_distance(pair, search);
    direction = normalized_or_zero(found.direction);
    return found.meet || found.distance <= pair.radii();
}

double separation_along(const SupportShape& a, const SupportShape& b, const Vec3& normal) {
    const SupportPair pair(a, b);
    const double gap = dot(pair.farthest(-normal).at, normal) - pair.radii();
    return (gap - 4 * pair.rounding()) / pair.factor();
}

} // namespace abut
