#include "clash/building/scenes_source.h"

#include "core/parallel.h"
#include "io/scene/model_frame.h"
#include "math/transform.h"

namespace abut {

namespace {

Box3 box_of_positions(const Mesh& mesh) {
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, p);
    return box;
}

/// The box of a box's eight corners.
Box3 moved_box(const Transform& t, const Box3& box) {
    Box3 moved;
    if (is_empty(box))
        return moved;
    for (unsigned corner = 0; corner < 8; ++corner)
        extend(moved, apply(t, {(corner & 1U) != 0 ? box.upper.x : box.lower.x,
                                (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                                (corner & 4U) != 0 ? box.upper.z : box.lower.z}));
    return moved;
}

} // namespace

ScenesSource::ScenesSource(const std::vector<Scene>& models, UpAxis up) : models_(models), up_(up) {
    std::vector<std::uint32_t> first_mesh;
    for (const Scene& model : models) {
        first_mesh.push_back(static_cast<std::uint32_t>(mesh_order_.size()));
        for (const Mesh& mesh : model.meshes) {
            mesh_order_.push_back(&mesh);
            meshes_.push_back({mesh.triangles.size(), {}});
        }
    }
    parallel_for(meshes_.size(), 64,
                 [&](std::size_t i) { meshes_[i].box = box_of_positions(*mesh_order_[i]); });
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        first_part_.push_back(static_cast<std::uint32_t>(parts_.size()));
        for (const Part& part : models[m].parts) {
            // Models of a caller may lack meshes: then the page has no geometry.
            if (part.mesh >= models[m].meshes.size()) {
                parts_.push_back({{}, m, 0});
                continue;
            }
            const std::uint32_t mesh = first_mesh[m] + part.mesh;
            parts_.push_back(
                {moved_box(turned(part.world_from_mesh, models[m].up, up), meshes_[mesh].box), m,
                 mesh});
        }
    }
}

std::uint32_t ScenesSource::part_of_report(std::uint32_t model, std::uint32_t part) const {
    return first_part_[model] + part;
}

Transform ScenesSource::world_from_mesh(std::uint32_t part) const {
    const std::uint32_t m = parts_[part].model;
    const Scene& model = models_[m];
    return turned(model.parts[part - first_part_[m]].world_from_mesh, model.up, up_);
}

void ScenesSource::for_each_piece(std::uint32_t mesh,
                                  const std::function<void(const Mesh&)>& take) const {
    take(*mesh_order_[mesh]);
}

} // namespace abut
