#include "convex/mesh_convexity.h"

#include <abut/error.h>

#include "convex/hull/climb.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace abut {

namespace {

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorCode::bad_mesh, "not a convex body: " + what);
}

Triangle corners(const std::vector<Vec3>& positions, const IndexTriangle& t) {
    return {positions[t[0]], positions[t[1]], positions[t[2]]};
}

/// Six times the volume, and twice the area.
struct Extent {
    double volume = 0, area = 0;
};

Extent extent(const std::vector<Vec3>& positions, const std::vector<IndexTriangle>& triangles) {
    Extent result;
    const Vec3& origin = positions.front();
    for (const IndexTriangle& index : triangles) {
        const auto [a, b, c] = corners(positions, index);
        result.volume += dot(a - origin, cross(b - origin, c - origin));
        result.area += length(cross(b - a, c - a));
    }
    return result;
}

} // namespace

void require_convex(const Mesh& mesh, const ConvexData& hull, double dent) {
    if (!is_closed(make_topology(mesh)))
        fail("the surface is not closed");
    if (hull.dimension < 3)
        fail("the vertices lie in one plane");
    const Polytope& polytope = hull.levels[0].polytope;
    std::uint32_t farthest = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = corners(mesh.positions, mesh.triangles[i]);
        const Vec3 area = cross(t[1] - t[0], t[2] - t[0]);
        const double longest =
            std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
        if (length(area) <= dent * longest)
            continue; // a needle thinner than a dent has no side
        const Vec3 normal = normalized_or_zero(area);
        farthest = climb(polytope, normal, farthest);
        if (const double depth = dot(normal, polytope.vertices[farthest].at - t[0]); depth > dent)
            fail(fmt::format("triangle {} is turned inside or lies in a dent: vertex {} is {:g} "
                             "in front of it",
                             i, hull.source[farthest], depth));
    }
    // All triangles lie on the hull. The volume tells whether they cover it once.
    const Extent given = extent(mesh.positions, mesh.triangles);
    const Extent wanted = extent(hull.vertices, hull.triangles);
    if (std::abs(given.volume - wanted.volume) > 3 * dent * (given.area + wanted.area))
        fail("the surface covers that of its hull more than once, or not all of it");
}

} // namespace abut
