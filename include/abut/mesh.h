#pragma once

#include <abut/types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// Indexed triangles. Any triangles: no orientation, closedness or manifoldness is asked for.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What an inspection finds. Vertices at equal positions count as one in everything topological.
struct MeshReport {
    std::size_t vertices = 0;             ///< as stored
    std::size_t distinct_vertices = 0;    ///< after equal positions are merged
    std::size_t triangles = 0;            ///< as stored
    std::size_t degenerate_triangles = 0; ///< of exactly zero area
    std::size_t duplicate_triangles = 0;  ///< beyond the first of the same three positions
    std::size_t boundary_edges = 0;       ///< used by one triangle
    std::size_t nonmanifold_edges = 0;    ///< used by three triangles or more
    std::size_t flipped_edges = 0;        ///< used by two triangles in the same direction
    std::size_t components = 0;           ///< sets of triangles connected by vertices
    bool closed = false;                  ///< every edge is used by exactly two triangles
    Box3 bounds;                          ///< of the vertices that a triangle uses
};

/// In/out      any mesh; never throws for bad topology.
/// Errors      Error{bad_mesh} if an index is out of range or a coordinate is not finite or beyond
///             1e18.
/// Cost        O(n log n) in the triangles.
MeshReport inspect(const Mesh& mesh);

} // namespace abut
