#pragma once

#include "convex/hull/normal_table.h"
#include "math/vector.h"
#include "mesh/surface_features.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Four neighbours of a vertex, coordinate by coordinate: two cache lines, which SIMD compares with
/// a direction at once.
struct alignas(64) RingBatch {
    static constexpr std::uint32_t kEdges = 4;
    std::array<double, kEdges> x{}, y{}, z{};
    std::array<std::uint32_t, kEdges> target{};
    std::array<std::uint32_t, kEdges> twin{}; ///< the same edge from the other end
};

struct HullVertex {
    Vec3 at;
    std::uint32_t first_edge = 0, degree = 0;
};

/// A convex polytope as a graph for walking: each vertex with the ring of its edges,
/// counter-clockwise as seen from outside. The surface is triangulated, so edges that are adjacent
/// in a ring span a triangle; some triangles may be coplanar.
///
/// An edge's number is its place in `rings`, which hold the position of its other end. So all
/// neighbours of a vertex lie in one run of memory. Each ring begins with a new batch. Unused lanes
/// of its last batch repeat its first edge; their numbers name no edge.
///
/// A point is a vertex without edges; a segment is two vertices with one edge each; a polygon has
/// triangles on both sides. No walk needs to treat them apart.
struct Polytope {
    std::vector<HullVertex> vertices;
    std::vector<RingBatch> rings; ///< ordered by vertex, then around it; padded at the end
    NormalTable starts;
    /// Only of a small hull: all x, then all y, all z, each padded to whole batches with the last
    /// vertex.
    std::vector<double> columns;

    /// One more than the largest number of an edge.
    [[nodiscard]] std::uint32_t edge_end() const {
        return static_cast<std::uint32_t>(rings.size()) * RingBatch::kEdges;
    }
    [[nodiscard]] Vec3 to(std::uint32_t edge) const {
        const RingBatch& batch = rings[edge / RingBatch::kEdges];
        const std::uint32_t k = edge % RingBatch::kEdges;
        return {batch.x[k], batch.y[k], batch.z[k]};
    }
    [[nodiscard]] std::uint32_t target(std::uint32_t edge) const {
        return rings[edge / RingBatch::kEdges].target[edge % RingBatch::kEdges];
    }
    [[nodiscard]] std::uint32_t twin(std::uint32_t edge) const {
        return rings[edge / RingBatch::kEdges].twin[edge % RingBatch::kEdges];
    }
    [[nodiscard]] std::uint32_t origin(std::uint32_t edge) const { return target(twin(edge)); }

    /// Next edge counter-clockwise around the vertex that this edge leaves from.
    [[nodiscard]] std::uint32_t after(const HullVertex& v, std::uint32_t edge) const {
        return edge + 1 == v.first_edge + v.degree ? v.first_edge : edge + 1;
    }
    [[nodiscard]] std::uint32_t before(const HullVertex& v, std::uint32_t edge) const {
        return edge == v.first_edge ? v.first_edge + v.degree - 1 : edge - 1;
    }
    [[nodiscard]] std::size_t bytes() const;

    static constexpr std::size_t kSmall = 64; ///< vertices of a hull that has columns, at most
};

/// In          an exact hull (exact_hull.h) of points that are all vertices: counter-clockwise
///             triangles, none for a point or a segment.
Polytope make_polytope(std::span<const Vec3> points, std::span<const IndexTriangle> triangles);

} // namespace abut
