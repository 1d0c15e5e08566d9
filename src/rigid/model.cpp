#include <abut/model.h>

#include "core/parallel.h"
#include "mesh/topology.h"
#include "rigid/model_data.h"
#include "rigid/tree_frame.h"

#include <cmath>

namespace abut {

ModelData::ModelData(Mesh mesh) : mesh_(std::move(mesh)) {
    require_valid(mesh_);
    model_from_tree_ = choose_tree_frame(mesh_);
    const Transform& f = model_from_tree_;
    const Vec3 origin{f.m[9], f.m[10], f.m[11]};
    const auto to_tree = [&](const Vec3& p) {
        const Vec3 d = p - origin;
        return Vec3{f.m[0] * d.x + f.m[1] * d.y + f.m[2] * d.z,
                    f.m[3] * d.x + f.m[4] * d.y + f.m[5] * d.z,
                    f.m[6] * d.x + f.m[7] * d.y + f.m[8] * d.z};
    };
    std::vector<Aabb> boxes(mesh_.triangles.size());
    parallel_for(boxes.size(), 2048, [&](std::size_t i) {
        Box3 box;
        double size = 0;
        for (const std::uint32_t v : mesh_.triangles[i]) {
            const Vec3& p = mesh_.positions[v];
            extend(box, to_tree(p));
            const Vec3 d = p - origin;
            size = std::max({size, std::abs(d.x) + std::abs(d.y) + std::abs(d.z),
                             std::abs(p.x) + std::abs(p.y) + std::abs(p.z)});
        }
        // A subtraction, a rounded rotation and three products and sums, each term below `size`.
        boxes[i] = Aabb(box, 8 * 0x1p-53 * size);
    });
    tree_ = build_tree(boxes);
    slots_.resize(mesh_.triangles.size());
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        slots_[slot] = mesh_.triangles[tree_.order[slot]];
}

std::size_t ModelData::bytes() const {
    return mesh_.positions.size() * sizeof(Vec3) + mesh_.triangles.size() * sizeof(slots_[0]) +
           slots_.size() * sizeof(slots_[0]) + tree_.bytes();
}

Model::Model(Mesh mesh) : data_(std::make_shared<const ModelData>(std::move(mesh))) {}
const Mesh& Model::mesh() const noexcept {
    return data_->mesh();
}
std::size_t Model::bytes() const noexcept {
    return data_->bytes();
}

} // namespace abut
