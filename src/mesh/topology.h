#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// One side of a triangle: from vertex `from` to vertex `to`, both merged by position.
struct HalfEdge {
    std::uint32_t from, to;
    std::uint32_t triangle;
    std::uint32_t apex; ///< the triangle's third vertex, as an index in the mesh
    [[nodiscard]] std::uint32_t lower() const { return from < to ? from : to; }
    [[nodiscard]] std::uint32_t upper() const { return from < to ? to : from; }
};

/// How triangles hang together once vertices at equal positions are merged.
struct Topology {
    std::vector<std::uint32_t>
        vertex_of; ///< mesh vertex -> merged vertex (an index of a mesh vertex at that position)
    std::vector<HalfEdge>
        half_edges; ///< by undirected edge; triangles with two equal vertices have none

    /// The half-edges between two merged vertices, in either direction.
    [[nodiscard]] std::span<const HalfEdge> edge(std::uint32_t v, std::uint32_t w) const;
};

/// In          a valid mesh (see require_valid).
/// Cost        O(n log n).
Topology make_topology(const Mesh& mesh);

/// Every edge is used by exactly two triangles, and there is an edge.
bool is_closed(const Topology& topology);

/// For each mesh vertex a number that vertices connected by triangles share.
std::vector<std::uint32_t> vertex_components(const Mesh& mesh, const Topology& topology);

/// One triangle of each set of triangles that merged vertices connect.
std::vector<std::uint32_t> component_representatives(const Mesh& mesh, const Topology& topology);

/// Squares of box sizes stay finite in single precision up to here.
inline constexpr double kLargestCoordinate = 1e18;

/// Errors      Error{bad_mesh} if a coordinate is not finite or beyond kLargestCoordinate.
void require_valid_positions(std::span<const Vec3> positions);

/// Errors      as for its positions; Error{bad_mesh} if an index is out of range.
void require_valid(const Mesh& mesh);

} // namespace abut
