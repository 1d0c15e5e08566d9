#include "world/narrow_phase/convex_gap.h"

#include "convex/body/convex_data.h"
#include "convex/hull/climb.h"
#include "geometry/supporting_normal.h"
#include "math/transform.h"

#include <algorithm>

namespace abut {

namespace {

/// Distances below this share of the coordinates do not tell their direction.
constexpr double kClearOfTouching = 0x1p-36;
/// Bound of the rounding of the way between two witness points, relative to the coordinates.
constexpr double kWayRounding = 0x1p-48;
/// A motion that is slight beside the bodies, but far above rounding, relative to their size.
constexpr double kSlightMotion = 0x1p-20;

/// The mean of the vertices, in the world, and the largest distance of a vertex from it.
struct MiddleAndReach {
    Vec3 middle;
    double reach = 0;

    MiddleAndReach(const Convex& convex, const Transform& world) {
        Vec3 sum;
        for (const Vec3& vertex : convex.vertices())
            sum = sum + vertex;
        middle = apply(world, (1.0 / static_cast<double>(convex.vertices().size())) * sum);
        for (const Vec3& vertex : convex.vertices())
            reach = std::max(reach, length(apply(world, vertex) - middle));
    }
};

/// The direction between two solids that touch, or are apart by little more than rounding. The way
/// between their closest points says nothing then; a face of their difference does, which the
/// shortest motion out of a slight overlap tells.
///
/// In          way: between the closest points. rounding: of that.
Vec3 direction_of_touching(const Convex& a, const Transform& world_from_a, const Convex& b,
                           const Transform& world_from_b, const Vec3& way, double rounding) {
    const MiddleAndReach of_a(a, world_from_a), of_b(b, world_from_b);
    const Vec3 inward = std::max(kSlightMotion * (of_a.reach + of_b.reach), 16 * rounding) *
                        normalized_or_zero(of_a.middle - of_b.middle);
    Transform moved = world_from_b;
    moved.m[9] += inward.x, moved.m[10] += inward.y, moved.m[11] += inward.z;
    const ConvexDepth depth = penetration(a, world_from_a, b, moved);
    const bool is_along = dot(way, depth.direction) >= length(way) - rounding;
    return depth.meet && depth.depth > 0 && is_along ? depth.direction : normalized_or_zero(way);
}

/// Turns a direction between the closest points of two solids so that it is across the edges and
/// faces that these lie on, to rounding.
Vec3 across_features(const Convex& a, const Transform& world_from_a, const Convex& b,
                     const Transform& world_from_b, const ConvexGap& gap, const Vec3& direction,
                     double rounding) {
    const PolytopePair pair(a.data().levels[0].polytope, world_from_a, b.data().levels[0].polytope,
                            world_from_b);
    const auto& m = world_from_a.m;
    const Vec3 origin{m[9], m[10], m[11]}, on_a = gap.point_a - origin, on_b = gap.point_b - origin;
    const auto highest = [](const PlacedPolytope& side, const Vec3& n) {
        return side.vertex(farthest(*side.polytope, side.pulled_back(n)));
    };
    return supporting_normal(
        direction, rounding, [&](const Vec3& n) { return highest(pair.a, n) - on_a; },
        [&](const Vec3& n) { return on_b - highest(pair.b, -n); });
}

} // namespace

BodyGap convex_gap(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, ConvexWarmStart& warm_start) {
    ConvexDistanceOptions options;
    options.warm_start = &warm_start;
    const ConvexGap gap = distance(a, world_from_a, b, world_from_b, options);
    BodyGap result;
    result.distance = gap.distance;
    result.point_a = gap.point_a, result.point_b = gap.point_b;
    result.normal = normalized_or_zero(gap.point_b - gap.point_a);
    const double size = sum_of_sizes(gap.point_a) + a.data().reach + b.data().reach;
    if (gap.distance > 0) {
        const double rounding = kWayRounding * size;
        if (gap.distance <= kClearOfTouching * size)
            result.normal = direction_of_touching(a, world_from_a, b, world_from_b,
                                                  gap.point_b - gap.point_a, rounding);
        if (gap.distance <= kTellsDirection * size)
            result.normal =
                across_features(a, world_from_a, b, world_from_b, gap, result.normal, rounding);
        return result;
    }
    const ConvexDepth depth =
        penetration(a, world_from_a, b, world_from_b, {.warm_start = &warm_start});
    if (!depth.meet)
        return result;
    result.distance = -depth.depth;
    result.point_a = depth.point_a, result.point_b = depth.point_b;
    result.normal = depth.direction;
    return result;
}

} // namespace abut
