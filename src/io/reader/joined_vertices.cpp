#include "io/reader/joined_vertices.h"

#include "mesh/equal_positions.h"

#include <cstddef>

namespace abut {

JoinedVertices join_vertices(std::span<const aiMesh* const> meshes) {
    JoinedVertices joined;
    auto& [positions, number_of] = joined;
    std::size_t vertices = 0;
    for (const aiMesh* const mesh : meshes)
        vertices += mesh->mNumVertices;
    positions.reserve(vertices);
    for (const aiMesh* const mesh : meshes)
        positions.insert(positions.end(), mesh->mVertices, mesh->mVertices + mesh->mNumVertices);

    number_of = join_equal_positions(positions);
    return joined;
}

} // namespace abut
