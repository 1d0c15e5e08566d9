#pragma once

#include <assimp/mesh.h>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The vertices of several meshes as one list, with equal positions joined (-0 equals 0).
///
/// Assimp gives each triangle of an OBJ or STL file separate vertices, and files separate vertices
/// that differ in normals or colours. Here only positions matter.
struct JoinedVertices {
    std::vector<aiVector3D> positions; ///< distinct, in the order of their first occurrence
    /// For each vertex of the meshes, one mesh after the other, its index in positions.
    std::vector<std::uint32_t> number_of;
};

/// In          meshes with fewer than 2^32 - 1 vertices in all. Vertices that no triangle uses are
///             included.
/// Cost        O(n) expected.
JoinedVertices join_vertices(std::span<const aiMesh* const> meshes);

} // namespace abut
