#include "deform/rest_model.h"

#include "core/parallel.h"
#include "deform/deformable_data.h"
#include "rigid/model/model_data.h"

#include <memory>

namespace abut {

namespace {

constexpr std::size_t kPositionsAtOnce = 8192;

Mesh mesh_at_start(const DeformableData& surface) {
    Mesh mesh;
    mesh.positions.resize(surface.vertices.size());
    parallel_for(mesh.positions.size(), kPositionsAtOnce,
                 [&](std::size_t i) { mesh.positions[i] = surface.vertices[i].start; });
    mesh.triangles = surface.triangles;
    return mesh;
}

} // namespace

Model RestModel::of(const DeformableData& surface) const {
    const std::scoped_lock lock(mutex_);
    if (!model_)
        isolated([&] {
            Mesh mesh = mesh_at_start(surface);
            if (outline_) {
                model_.emplace(std::make_shared<const ModelData>(std::move(mesh), *outline_));
                return;
            }
            model_.emplace(std::move(mesh), ModelOptions{.volume = Volume::aabb, .progress = {}});
            outline_ = std::make_shared<const ModelOutline>(model_->data().outline());
        });
    return *model_;
}

std::size_t RestModel::bytes() const {
    const std::scoped_lock lock(mutex_);
    std::size_t bytes = model_ ? model_->bytes() : 0;
    if (outline_)
        bytes += outline_->tree.nodes.size() * sizeof(outline_->tree.nodes[0]) +
                 outline_->tree.order.size() * sizeof(outline_->tree.order[0]);
    return bytes;
}

} // namespace abut
