#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstddef>
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

/// The connectivity of triangles after vertices at equal positions are merged.
struct Topology {
    std::vector<std::uint32_t>
        vertex_of; ///< mesh vertex -> merged vertex, the index of the first mesh vertex at that
                   ///< position
    std::vector<HalfEdge>
        half_edges; ///< sorted by undirected edge; a triangle with two equal vertices has none

    /// The half-edges that connect two merged vertices, in either direction.
    [[nodiscard]] std::span<const HalfEdge> edge(std::uint32_t v, std::uint32_t w) const;
};

/// Computes a mesh's connectivity.
/// In          a valid mesh (see require_valid).
/// Cost        O(n log n).
Topology make_topology(const Mesh& mesh);

/// Whether every edge is used by exactly two triangles, and there is at least one edge.
bool is_closed(const Topology& topology);

/// A component number for each mesh vertex. Vertices connected by triangles have the same number.
std::vector<std::uint32_t> vertex_components(const Mesh& mesh, const Topology& topology);

/// One triangle of each connected component of triangles with merged vertices.
std::vector<std::uint32_t> component_representatives(const Mesh& mesh, const Topology& topology);

/// Largest coordinate for which squares of box sizes stay finite in single precision.
inline constexpr double kLargestCoordinate = 1e18;

/// Checks the position of a vertex.
/// Errors      Error{bad_mesh}, which names the vertex, if a coordinate is not finite or beyond
///             kLargestCoordinate.
void require_valid_position(const Vec3& position, std::size_t vertex);
/// Checks the positions of all vertices. Errors as require_valid_position.
void require_valid_positions(std::span<const Vec3> positions);

/// Checks a mesh.
/// Errors      as require_valid_positions; Error{bad_mesh} if an index is out of range.
void require_valid(const Mesh& mesh);

} // namespace abut
