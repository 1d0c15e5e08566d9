#include "mesh/used_positions.h"

#include "math/transform.h"

namespace abut {

UsedPositions::UsedPositions(const Mesh& mesh) : all_(&mesh.positions) {
    std::vector<bool> used(mesh.positions.size());
    std::size_t count = 0;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            count += used[v] ? 0 : 1;
            used[v] = true;
        }
    if (count == used.size())
        return;
    all_ = nullptr;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v])
            some_.push_back(mesh.positions[v]);
}

Box3 world_box(const std::vector<Vec3>& positions, const Transform& world_from_mesh) {
    Box3 box;
    for (const Vec3& p : positions)
        extend(box, apply(world_from_mesh, p));
    return box;
}

} // namespace abut
