#include "world/narrow_phase/model_gap.h"

#include <abut/rigid.h>

#include "math/transform.h"
#include "math/vector.h"
#include "rigid/manifold/touching_direction.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Bounds the rounding of the difference of two points, relative to the sum of their coordinates and of
/// those of the places of their bodies.
constexpr double kRoundingOfWay = 0x1p-49;

BodyGap from_rigid(const Gap& gap, const Vec3& normal) {
    return {{},          {},     gap.distance,   gap.point_a,
            gap.point_b, normal, gap.triangle_a, gap.triangle_b,
            gap.status};
}

/// Returns the normal of a triangle if the direction of a way differs from it by no more than the way's
/// rounding explains. Otherwise returns the way's direction.
///
/// In          error: bounds the rounding of the way.
Vec3 without_rounding(const Vec3& way, double error, const Model& model, const Transform& world,
                      std::uint32_t triangle) {
    constexpr double kMostTurned = 0x1p-5; // radians; a way shorter than its rounding tells nothing
    const Vec3 direction = normalized_or_zero(way);
    const Mesh& mesh = model.mesh();
    if (direction == Vec3{} || triangle >= mesh.triangles.size())
        return direction;
    const auto& corners = mesh.triangles[triangle];
    const auto corner = [&](std::size_t i) { return apply(world, mesh.positions[corners[i]]); };
    const Vec3 p = corner(0), normal = normalized_or_zero(cross(corner(1) - p, corner(2) - p));
    const double turned = std::min(kMostTurned, error / length(way));
    if (length(direction - normal) <= turned)
        return normal;
    return length(direction + normal) <= turned ? -normal : direction;
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
    const double error =
        kRoundingOfWay * (sum_of_sizes(world_from_a) + sum_of_sizes(world_from_b) +
                          sum_of_sizes(found.point_a) + sum_of_sizes(found.point_b));
    Vec3 direction = without_rounding(way, error, a, world_from_a, found.triangle_a);
    if (direction == normalized_or_zero(way))
        direction = without_rounding(way, error, b, world_from_b, found.triangle_b);
    // The depth of open surfaces is told at one common point.
    const bool at_one_point = length(between) < 0.5 * -found.distance;
    BodyGap gap = from_rigid(found, at_one_point ? Vec3{} : direction);
    const bool has_points = found.distance <= options.upper_bound;
    if (has_points && (found.distance > 0 || depths == Depths::yes))
        if (const auto normal =
                direction_of_touching(a, world_from_a, b, world_from_b, found.point_a,
                                      found.point_b, way, std::abs(found.distance)))
            gap.normal = *normal;
    if (at_one_point && gap.normal != Vec3{})
        gap.point_b = gap.point_a + gap.distance * gap.normal;
    // The depth of a point in a solid is a bound of the length of a separating motion, however
    // exact it is.
    if (gap.distance < 0)
        gap.status = Status::bound_only;
    return gap;
}

Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points)
        sum = sum + p;
    return (1 / static_cast<double>(points.size())) * sum;
}

void turn_to_solid(BodyGap& gap, const Vec3& inside, double size) {
    constexpr double kShallow = 0x1p-20;
    if (std::abs(gap.distance) > kShallow * size || dot(gap.normal, inside - gap.point_b) >= 0)
        return;
    gap.normal = -gap.normal;
    gap.point_b = gap.point_a + gap.distance * gap.normal;
}

} // namespace abut
