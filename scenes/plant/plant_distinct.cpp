#include "scenes/plant/plant_distinct.h"

#include "scenes/random.h"

#include <algorithm>
#include <utility>

namespace abut::scenes {

namespace {

/// Rotates the list of triangles and the corners of each by random amounts, so that no two parts
/// get the same mesh, except for very small meshes.
Mesh in_another_order(const Mesh& mesh, std::uint64_t seed) {
    Mesh result = mesh;
    Random random(seed);
    auto& triangles = result.triangles;
    if (triangles.empty())
        return result;
    std::rotate(triangles.begin(),
                triangles.begin() + static_cast<std::ptrdiff_t>(random.next() % triangles.size()),
                triangles.end());
    for (auto& triangle : triangles)
        std::rotate(triangle.begin(), triangle.begin() + random.below(3), triangle.end());
    return result;
}

} // namespace

void make_distinct(Plant& plant) {
    std::vector<Mesh> meshes;
    std::vector<bool> closed;
    meshes.reserve(plant.scene.parts.size());
    for (Part& part : plant.scene.parts) {
        meshes.push_back(in_another_order(plant.scene.meshes[part.mesh], meshes.size()));
        closed.push_back(plant.mesh_closed[part.mesh]);
        part.mesh = static_cast<std::uint32_t>(meshes.size() - 1);
    }
    plant.scene.meshes = std::move(meshes);
    plant.mesh_closed = std::move(closed);
}

} // namespace abut::scenes
