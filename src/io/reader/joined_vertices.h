#pragma once

#include <assimp/mesh.h>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The vertices of several meshes as those of one, equal positions joined (-0 equals 0).
///
/// Assimp gives each triangle of an OBJ or STL vertices of its own, and files part vertices where
/// normals or colours do; here positions are all there is.
struct JoinedVertices {
    std::vector<aiVector3D> positions; ///< none twice, in the order of their first occurrence
    /// Of each vertex of the meshes, one mesh after the other, its number in positions.
    std::vector<std::uint32_t> number_of;
};

/// In          meshes with fewer than 2^32 - 1 vertices in all; vertices that no triangle uses are
///             vertices like others.
/// Cost        O(n) expected.
JoinedVertices join_vertices(std::span<const aiMesh* const> meshes);

} // namespace abut
