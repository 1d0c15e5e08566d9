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
    if (!last_ || !is_current_) {
        isolated([&] {
            Mesh mesh = mesh_at_start(surface);
            if (last_)
                last_ = Model(
                    std::make_shared<const ModelData>(std::move(mesh), last_->data().outline()));
            else
                last_ = Model(std::move(mesh));
        });
        is_current_ = true;
    }
    return *last_;
}

std::size_t RestModel::bytes() const {
    const std::scoped_lock lock(mutex_);
    return last_ ? last_->bytes() : 0;
}

} // namespace abut
