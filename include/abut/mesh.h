#pragma once

#include <abut/types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// Indexed triangles. They need not be oriented, closed or manifold.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The findings of `inspect`. For all topology, vertices at equal positions count as one.
struct MeshReport {
    std::size_t vertices = 0;             ///< as stored
    std::size_t distinct_vertices = 0;    ///< after equal positions are merged
    std::size_t triangles = 0;            ///< as stored
    std::size_t degenerate_triangles = 0; ///< of exactly zero area
    std::size_t duplicate_triangles = 0;  ///< repetitions of another triangle's three positions
    std::size_t boundary_edges = 0;       ///< used by one triangle
    std::size_t nonmanifold_edges = 0;    ///< used by three triangles or more
    std::size_t flipped_edges = 0;        ///< used by two triangles in the same direction
    std::size_t components = 0;           ///< sets of triangles connected through vertices
    bool closed = false;                  ///< every edge is used by exactly two triangles
    Box3 bounds;                          ///< of the vertices that triangles use
};

/// Counts the properties and the defects of a mesh.
///
/// In/out      any mesh; bad topology is not an error.
/// Errors      Error{bad_mesh} if an index is out of range or a coordinate is not finite or beyond
///             1e18.
/// Cost        O(n log n) in the triangles.
MeshReport inspect(const Mesh& mesh);

} // namespace abut
