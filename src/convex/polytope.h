#pragma once

#include "convex/normal_table.h"
#include "math/vector.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// An edge of a polytope as one of its ends sees it. It holds where the other end is, so that a
/// look at all neighbours of a vertex touches one run of memory.
struct HullEdge {
    Vec3 to;
    std::uint32_t target = 0;
    std::uint32_t twin = 0; ///< the same edge from the other end
};

struct HullVertex {
    Vec3 at;
    std::uint32_t first_edge = 0, degree = 0;
};

/// A convex polytope as a graph for walking: every vertex with the ring of its edges,
/// counter-clockwise as seen from outside. The surface is triangulated, so that edges next to each
/// other in a ring span a triangle; some triangles may be coplanar.
///
/// A point is a vertex without edges, a segment two with one edge each, a polygon has triangles on
/// both sides: nothing that walks needs to know.
struct Polytope {
    std::vector<HullVertex> vertices;
    std::vector<HullEdge> edges; ///< by vertex, then around it
    NormalTable starts;

    /// Next edge counter-clockwise around the vertex that this edge leaves from.
    [[nodiscard]] std::uint32_t after(const HullVertex& v, std::uint32_t edge) const {
        return edge + 1 == v.first_edge + v.degree ? v.first_edge : edge + 1;
    }
    [[nodiscard]] std::uint32_t before(const HullVertex& v, std::uint32_t edge) const {
        return edge == v.first_edge ? v.first_edge + v.degree - 1 : edge - 1;
    }
    [[nodiscard]] std::uint32_t origin(std::uint32_t edge) const {
        return edges[edges[edge].twin].target;
    }
};

/// In          an exact hull (exact_hull.h) of points that are all vertices: counter-clockwise
///             triangles, none for a point or a segment.
Polytope make_polytope(std::span<const Vec3> points, std::span<const IndexTriangle> triangles);

/// A vertex of the polytope that is farthest along a direction, by going uphill from `start`.
std::uint32_t climb(const Polytope& polytope, const Vec3& direction, std::uint32_t start);

/// The same, from where the table of normals says.
inline std::uint32_t farthest(const Polytope& polytope, const Vec3& direction) {
    return climb(polytope, direction, polytope.starts.vertex(direction));
}

} // namespace abut
