#include "rigid/penetration/local_penetration.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/penetration/separating_motion.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace abut {

namespace {

LocalPenetration deepest_crossing(const WorldSolid& a, const WorldSolid& b,
                                  std::span<const Contact> contacts) {
    LocalPenetration best;
    for (const Contact& c : contacts) {
        if (c.kind != TriangleContact::cross)
            continue;
        const Triangle ta = a.world_triangle(c.pair.a), tb = b.world_triangle(c.pair.b);
        const TriangleSeparation s = triangle_triangle_penetration(ta, tb);
        if (s.depth > best.depth) {
            const ClosestPoints common = triangle_triangle_distance(ta, tb);
            best = {s.depth, s.depth, 0, false, common.a, common.b, s.direction, c.pair};
        }
    }
    return best;
}

/// Some of the triangles in contact: deep points are likely near them.
std::vector<std::uint32_t> some_triangles(std::span<const Contact> contacts,
                                          std::uint32_t TrianglePair::*side) {
    constexpr std::size_t kTriangles = 8;
    std::vector<std::uint32_t> triangles;
    const std::size_t count = std::min(kTriangles, contacts.size());
    for (std::size_t i = 0; i < count; ++i)
        triangles.push_back(contacts[i * contacts.size() / count].pair.*side);
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

/// The triangles that belong to a mesh block, by their numbers in the block.
std::vector<std::uint32_t> in_block(const std::vector<std::uint32_t>& triangles,
                                    const WorldSolid::Block& block) {
    if (block.numbers.empty())
        return triangles;
    std::vector<std::uint32_t> local;
    for (const std::uint32_t triangle : triangles) {
        const auto found = std::lower_bound(block.numbers.begin(), block.numbers.end(), triangle);
        if (found != block.numbers.end() && *found == triangle)
            local.push_back(static_cast<std::uint32_t>(found - block.numbers.begin()));
    }
    return local;
}

/// Searches block by block; each block has to exceed the depth reached so far.
DeepestPoint deepest_of(const WorldSolid& surface, const WorldSolid& solid,
                        const std::vector<std::uint32_t>& starts, const SurfacePart& part,
                        const DepthSearch& options, double deeper_than) {
    DeepestPoint best;
    best.depth = best.at_most = deeper_than;
    surface.for_each_surface_block(solid.world_box(), [&](const WorldSolid::Block& block) {
        const double at_most = best.at_most;
        SurfacePart of_block = part;
        of_block.numbers = block.numbers;
        DeepestPoint found = find_deepest_point(block.model, solid, in_block(starts, block),
                                                of_block, options, best.depth);
        if (found.depth > best.depth) {
            found.surface_triangle = block.number(found.surface_triangle);
            best = found;
        }
        best.at_most = std::max(at_most, found.at_most);
        return true;
    });
    return best;
}

/// The penetration at the deepest point of one model's surface in the other one, a solid.
LocalPenetration penetration_at(const DeepestPoint& p, bool surface_is_a) {
    LocalPenetration result;
    result.depth = p.depth, result.at_most = p.at_most, result.is_in_solid = true;
    result.point_a = surface_is_a ? p.on_surface : p.on_solid;
    result.point_b = surface_is_a ? p.on_solid : p.on_surface;
    result.direction = normalized_or_zero(result.point_a - result.point_b);
    result.triangles = surface_is_a ? TrianglePair{p.surface_triangle, p.solid_triangle}
                                    : TrianglePair{p.solid_triangle, p.surface_triangle};
    return result;
}

LocalPenetration deepest_inside(const WorldSolid& a, const WorldSolid& b,
                                std::span<const Contact> contacts, const DepthSearch& options,
                                const SurfacePart& part_a, const SurfacePart& part_b) {
    LocalPenetration best;
    if (b.bounds_solid()) {
        const DeepestPoint p =
            deepest_of(a, b, some_triangles(contacts, &TrianglePair::a), part_a, options, 0);
        best = penetration_at(p, true);
    }
    if (a.bounds_solid()) {
        const DeepestPoint p = deepest_of(b, a, some_triangles(contacts, &TrianglePair::b), part_b,
                                          options, best.depth);
        const double at_most = std::max(best.at_most, p.at_most);
        if (p.depth > best.depth)
            best = penetration_at(p, false);
        best.at_most = at_most;
    }
    return best;
}

/// A vertex of a; near the contacts if there are any.
Vec3 origin_of(const WorldSolid& a, std::span<const Contact> contacts) {
    if (!contacts.empty())
        return a.world_triangle(contacts[0].pair.a)[0];
    const std::vector<Vec3> points = a.component_points();
    return points.empty() ? Vec3{} : points[0];
}

} // namespace

double depth_rounding(const WorldSolid& a, const WorldSolid& b) {
    return 0x1p-47 * (a.world_size() + b.world_size());
}

LocalPenetration local_penetration(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options,
                                   const SurfacePart& part_a, const SurfacePart& part_b) {
    const Vec3 origin = origin_of(a, contacts);
    const std::unique_ptr<const WorldSolid> seen_a = a.seen_from(origin),
                                            seen_b = b.seen_from(origin);
    LocalPenetration result;
    if (!a.bounds_solid() && !b.bounds_solid()) {
        result = deepest_crossing(*seen_a, *seen_b, contacts);
    } else {
        const auto seen = [&](SurfacePart part) {
            part.origin = origin;
            return part;
        };
        result = deepest_inside(*seen_a, *seen_b, contacts, options, seen(part_a), seen(part_b));
        result.rounding = depth_rounding(a, b);
    }
    result.point_a = result.point_a + origin, result.point_b = result.point_b + origin;
    return result;
}

LocalPenetration locked_depth(const WorldSolid& a, const WorldSolid& b,
                              std::span<const Contact> contacts) {
    const SeparatingMotion escape = find_separating_motion(a, b, contacts);
    const TrianglePair& first = contacts[0].pair;
    const ClosestPoints common =
        triangle_triangle_distance(a.world_triangle(first.a), b.world_triangle(first.b));
    LocalPenetration result;
    result.depth = result.at_most = escape.length;
    result.point_a = common.a, result.point_b = common.b;
    result.direction = escape.direction;
    result.triangles = first;
    return result;
}

LocalPenetration penetration_depth(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options) {
    const LocalPenetration found = local_penetration(a, b, contacts, options);
    const bool ran_out = options.steps != nullptr && options.steps->ran_out();
    return found.depth > 0 || ran_out ? found : locked_depth(a, b, contacts);
}

} // namespace abut
