#include "rigid/local_penetration.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/escape.h"

#include <algorithm>
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
            best = {s.depth, s.depth, common.a, common.b, s.direction, c.pair};
        }
    }
    return best;
}

/// A few of the triangles in contact: deep points are near them.
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

/// Of a surface's triangles, those that a block has, by their numbers there.
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

/// Block by block: what one has reached is the least that matters in the next.
DeepestPoint deepest_of(const WorldSolid& surface, const WorldSolid& solid,
                        const std::vector<std::uint32_t>& starts, const SurfacePart& part,
                        const DepthSearch& options, double deeper_than) {
    DeepestPoint best;
    best.depth = best.at_most = deeper_than;
    surface.for_each_block(solid.world_box(), [&](const WorldSolid::Block& block) {
        const double at_most = best.at_most;
        DeepestPoint found = find_deepest_point(block.model, solid, in_block(starts, block), part,
                                                options, best.depth);
        if (found.depth > best.depth) {
            found.surface_triangle = block.number(found.surface_triangle);
            best = found;
        }
        best.at_most = std::max(at_most, found.at_most);
        return true;
    });
    return best;
}

LocalPenetration deepest_inside(const WorldSolid& a, const WorldSolid& b,
                                std::span<const Contact> contacts, const DepthSearch& options,
                                const SurfacePart& part_a, const SurfacePart& part_b) {
    LocalPenetration best;
    if (b.bounds_solid()) {
        const DeepestPoint p =
            deepest_of(a, b, some_triangles(contacts, &TrianglePair::a), part_a, options, 0);
        best = {p.depth, p.at_most, p.on_surface, p.on_solid,
                normalized_or_zero(p.on_surface - p.on_solid)};
        best.triangles = {p.surface_triangle, p.solid_triangle};
    }
    if (a.bounds_solid()) {
        const DeepestPoint p = deepest_of(b, a, some_triangles(contacts, &TrianglePair::b), part_b,
                                          options, best.depth);
        if (p.depth > best.depth) {
            best = {p.depth, best.at_most, p.on_solid, p.on_surface,
                    normalized_or_zero(p.on_solid - p.on_surface)};
            best.triangles = {p.solid_triangle, p.surface_triangle};
        }
        best.at_most = std::max(best.at_most, p.at_most);
    }
    return best;
}

} // namespace

LocalPenetration local_penetration(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options,
                                   const SurfacePart& part_a, const SurfacePart& part_b) {
    return a.bounds_solid() || b.bounds_solid()
               ? deepest_inside(a, b, contacts, options, part_a, part_b)
               : deepest_crossing(a, b, contacts);
}

LocalPenetration penetration_depth(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options) {
    LocalPenetration best = local_penetration(a, b, contacts, options);
    if (best.depth == 0) {
        const Escape escape = find_escape(a, b, contacts);
        const ClosestPoints common = triangle_triangle_distance(
            a.world_triangle(contacts[0].pair.a), b.world_triangle(contacts[0].pair.b));
        best = {escape.length, escape.length, common.a, common.b, escape.direction};
    }
    return best;
}

} // namespace abut
