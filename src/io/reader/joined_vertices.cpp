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

    number_of = first_equal_positions(std::span(positions));
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < number_of.size(); ++i) {
        const std::uint32_t first = number_of[i];
        if (first < i) {
            number_of[i] = number_of[first];
            continue;
        }
        positions[count] = positions[i];
        number_of[i] = count++;
    }
    positions.resize(count);
    return joined;
}

} // namespace abut
