#include "convex/support/support_gap.h"

#include "convex/support/planar_gap.h"
#include "convex/support/refined_gap.h"
#include "convex/support/support_depth.h"
#include "convex/support/support_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace abut {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The gap of two cores in the frame of a pair, and the points that have it.
struct CoreGap {
    double distance = 0;
    Vec3 normal; ///< zero: not known
    DifferencePoint points;
    bool bounds_agree = true;
};

CoreGap core_gap(const RefinedGap& gap) {
    return {-gap.value, -gap.outward, gap.points, true};
}

/// A plain answer that the search may end with.
bool is_enough(const SupportSearch& search, double distance, double at_least) {
    return at_least > search.apart || distance <= search.near;
}

CoreGap gap_of_parallel_axes(const SupportPair& pair, const SupportSearch& search) {
    const PlanarGap planar = planar_gap(pair, -search.apart, -search.near);
    const RefinedGap found{planar.outward, planar.value, planar.nearest.nearest()};
    if (is_enough(search, -planar.at_least, -planar.value))
        return core_gap(found);
    const double error = kCertainRoundings * pair.rounding();
    CoreGap gap =
        core_gap(refined(pair, planar.outward, planar.nearest, planar.value + error, {0, 1, 0})
                     .value_or(found));
    gap.bounds_agree = planar.value - planar.at_least <= 4 * kDepthTolerance;
    return gap;
}

CoreGap gap_of_depth(const SupportPair& pair, const SupportSimplex& simplex, DepthEffort effort) {
    const SupportDepth depth = support_depth(pair, simplex, effort);
    const bool bounds_agree =
        depth.depth - depth.at_least <= 4 * std::max(kDepthTolerance, 2 * pair.rounding());
    const double lower = effort == DepthEffort::bound ? depth.at_least : depth.depth;
    return {bounds_agree ? -depth.depth : -lower,
            depth.normal,
            {{}, depth.point_a, depth.point_b},
            bounds_agree};
}

/// Turns the direction of a gap that is so short that rounding tilts it. Cores that are slightly in each
/// other have the same direction, which the shortest motion out of that tells.
CoreGap with_direction_of_depth(const SupportPair& pair, CoreGap gap) {
    constexpr double kSlight =
        0x1p-32; // far above rounding, far below the sizes, which are about 1
    if (gap.distance > kSlight)
        return gap;
    const SupportPair moved = pair.moved(-(gap.distance + kSlight) * gap.normal);
    const SupportDistance found = support_distance(moved, {});
    if (!found.meet)
        return gap;
    const Vec3 normal = support_depth(moved, found.simplex, DepthEffort::full).normal;
    const auto apart = [&](const Vec3& n) { return dot(pair.farthest(-n).at, n); };
    if (apart(normal) > apart(gap.normal))
        gap.normal = normal;
    return gap;
}

CoreGap gap_in_space(const SupportPair& pair, const SupportSearch& search, SupportDepths depths) {
    const SupportDistance found = support_distance(pair, search);
    const DepthEffort effort =
        depths == SupportDepths::yes ? DepthEffort::full : DepthEffort::bound;
    if (found.meet && depths == SupportDepths::no)
        return {0, {}, found.simplex.nearest(), true};
    if (found.meet)
        return gap_of_depth(pair, found.simplex, effort);
    const Vec3 outward = (-1 / found.distance) * found.direction;
    const CoreGap plain{found.distance, -outward, found.simplex.nearest(),
                        found.distance - found.at_least <= 4 * kDepthTolerance};
    if (is_enough(search, found.distance, found.at_least))
        return plain;
    // Nothing proves that the cores are apart, nor that they meet: the polytope decides.
    if (!plain.bounds_agree && found.at_least <= 0)
        if (const CoreGap gap = gap_of_depth(pair, found.simplex, DepthEffort::full);
            gap.distance <= 0)
            return gap;
    const double error = kCertainRoundings * pair.rounding();
    const auto better = refined(pair, outward, found.simplex, error - found.at_least);
    if (better && -better->value <= found.distance + error)
        return core_gap(*better);
    return with_direction_of_depth(pair, plain);
}

/// An order of shapes by nothing but what they are, so that a pair has one answer.
bool comes_after(const SupportShape& a, const SupportShape& b) {
    const auto key = [](const SupportShape& s) {
        const auto& [x, y, z] = s.axis;
        return std::tuple(s.kind, s.half, s.radius, s.reach, s.centre.x, s.centre.y, s.centre.z,
                          x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z);
    };
    return key(b) < key(a);
}

SupportGap turned_round(const SupportGap& gap) {
    return {gap.distance, gap.point_b, gap.point_a, -gap.normal, gap.bounds_agree};
}

/// The gap in the world. Lengths below what rounding can tell are 0.
SupportGap to_world(const SupportPair& pair, const CoreGap& core, const Vec3& origin) {
    const double scale = 1 / pair.factor();
    const double gap = core.distance - pair.radii();
    SupportGap result;
    result.distance = std::abs(gap) <= kTouchRoundings * pair.rounding() ? 0 : scale * gap;
    result.normal = core.normal, result.bounds_agree = core.bounds_agree;
    result.point_a = origin + scale * (core.points.a + pair.a().radius * core.normal);
    result.point_b = origin + scale * (core.points.b - pair.b().radius * core.normal);
    return result;
}

SupportGap ordered_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                       SupportDepths depths) {
    const auto search_of = [&](const SupportPair& pair) {
        const double certain = kCertainRoundings * pair.rounding();
        SupportSearch search;
        search.apart = pair.factor() * std::max(upper_bound, 0.0) + pair.radii() + certain;
        search.near = -kNever;
        return search;
    };
    if (const std::optional<ParallelAxes> axes = parallel_axes(a, b)) {
        const SupportPair pair(axes->a, axes->b);
        SupportGap gap = to_world(pair, gap_of_parallel_axes(pair, search_of(pair)), {});
        gap.normal = axes->to_world(gap.normal);
        gap.point_a = a.centre + (axes->origin + axes->to_world(gap.point_a));
        gap.point_b = a.centre + (axes->origin + axes->to_world(gap.point_b));
        return gap;
    }
    const SupportPair pair(a, b);
    return to_world(pair, gap_in_space(pair, search_of(pair), depths), a.centre);
}

/// The gap in either order of the shapes.
SupportGap gap_of(const SupportShape& a, const SupportShape& b, double upper_bound,
                  SupportDepths depths, Vec3& direction) {
    if (direction != Vec3{}) {
        const double apart = separation_along(a, b, direction);
        if (apart > std::max(upper_bound, 0.0))
            return {apart, {}, {}, direction, true};
    }
    const SupportGap gap = comes_after(a, b) ? turned_round(ordered_gap(b, a, upper_bound, depths))
                                             : ordered_gap(a, b, upper_bound, depths);
    if (gap.normal != Vec3{})
        direction = gap.normal;
    return gap;
}

} // namespace

SupportGap support_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                       SupportDepths depths, Vec3& direction) {
    return gap_of(a, b, upper_bound, depths, direction);
}

Vec3 common_point(const SupportShape& a, const SupportShape& b) {
    const SupportPair pair(a, b);
    const DifferencePoint points = support_distance(pair, {}).simplex.nearest();
    const Vec3 way = points.b - points.a;
    const double distance = length(way);
    // Within the radius of a from the one point, and within that of b from the other.
    const double along =
        std::clamp(0.5 * (distance + pair.a().radius - pair.b().radius), 0.0, distance);
    const Vec3 at = distance > 0 ? points.a + (along / distance) * way : points.a;
    return a.centre + (1 / pair.factor()) * at;
}

double separation_along(const SupportShape& a, const SupportShape& b, const Vec3& normal) {
    const SupportPair pair(a, b);
    const double gap = dot(pair.farthest(-normal).at, normal) - pair.radii();
    return (gap - kCertainRoundings * pair.rounding()) / pair.factor();
}

} // namespace abut
