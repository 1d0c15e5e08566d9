#include <abut/model.h>

#include "core/parallel.h"
#include "core/stop.h"
#include "mesh/topology.h"
#include "rigid/model/model_data.h"
#include "rigid/model/tree_frame.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The power of two that scales half the box to 1 or slightly less, limited so that single
/// precision can square it.
double scale_of(const Box3& box) {
    const Vec3 half = is_empty(box) ? Vec3{} : 0.5 * (box.upper - box.lower);
    const double size = std::max({half.x, half.y, half.z});
    return size > 0 ? std::ldexp(1, std::clamp(std::ilogb(size) + 1, -30, 62)) : 1;
}

/// In: model_from_tree is a rotation times the scale.
std::vector<Vec3> tree_positions(const Mesh& mesh, const Box3& bounds,
                                 const Transform& model_from_tree, double scale) {
    const auto& f = model_from_tree.m;
    const double factor = 1 / (scale * scale); // the inverse of s R is R^T / s = (s R)^T / s^2
    std::vector<Vec3> result(mesh.positions.size());
    parallel_for(mesh.positions.size(), 8192, [&](std::size_t i) {
        const Vec3 d = factor * from_middle(bounds, mesh.positions[i]);
        result[i] = {f[0] * d.x + f[1] * d.y + f[2] * d.z, f[3] * d.x + f[4] * d.y + f[5] * d.z,
                     f[6] * d.x + f[7] * d.y + f[8] * d.z};
    });
    return result;
}

} // namespace

ModelData::ModelData(Mesh mesh, const ModelOptions& options)
    : mesh_(std::move(mesh)), volume_(options.volume) {
    const StopScope scope(options.progress);
    build(nullptr);
}

ModelData::ModelData(Mesh mesh, const ModelOutline& outline) : mesh_(std::move(mesh)) {
    build(&outline);
}

/// In: null if no outline is known.
void ModelData::build(const ModelOutline* outline) {
    require_valid(mesh_);
    Box3 bounds;
    for (const auto& t : mesh_.triangles)
        for (const std::uint32_t v : t)
            extend(bounds, mesh_.positions[v]);
    diagonal_ = is_empty(bounds) ? 0 : length(bounds.upper - bounds.lower);
    const double scale = scale_of(bounds);
    const TreeFrame frame = outline == nullptr ? choose_tree_frame(mesh_, bounds)
                                               : tree_frame(mesh_, bounds, outline->axes);
    axes_ = frame.axes;
    model_from_tree_ = frame.model_from_tree;
    for (std::size_t i = 0; i < 9; ++i)
        model_from_tree_.m[i] *= scale;
    const std::vector<Vec3> positions = tree_positions(mesh_, bounds, model_from_tree_, scale);
    const TreeMesh tree_mesh{positions, mesh_.triangles};
    tree_ = outline == nullptr ? build_tree(tree_mesh, volume_ != Volume::aabb)
                               : build_tree(tree_mesh, outline->tree);
    volumes_ = build_volume_tree(volume_, tree_, tree_mesh);
    sort_vertices();
    if (!tree_.empty())
        first_in_tree_ = positions[mesh_.triangles[tree_.order[0]][0]];
    support_ = SupportBound(vertices_);
}

void ModelData::sort_vertices() {
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> sorted(mesh_.positions.size(), kNone);
    vertices_.reserve(mesh_.positions.size());
    slots_.resize(tree_.order.size());
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh_.triangles[tree_.order[slot]][k];
            if (sorted[vertex] == kNone) {
                sorted[vertex] = static_cast<std::uint32_t>(vertices_.size());
                vertices_.push_back(mesh_.positions[vertex]);
            }
            slots_[slot][k] = sorted[vertex];
        }
}

std::size_t ModelData::bytes() const {
    return (volumes_ ? volumes_->bytes() : 0) + mesh_.positions.size() * sizeof(Vec3) +
           mesh_.triangles.size() * sizeof(mesh_.triangles[0]) + tree_.bytes() +
           vertices_.size() * sizeof(Vec3) + slots_.size() * sizeof(slots_[0]);
}

std::uint64_t most_model_bytes(std::uint64_t triangles, std::uint64_t vertices) {
    // Measured; a property test checks that models stay below it.
    constexpr std::uint64_t kOfTriangle = 74, kOfVertex = 60, kOfModel = 2048;
    return kOfTriangle * triangles + kOfVertex * vertices + kOfModel;
}

Model baked(const Model& model, const Transform& world) {
    Mesh mesh = model.mesh();
    for (Vec3& p : mesh.positions)
        p = apply(world, p);
    return Model(std::move(mesh), {.volume = model.data().volume()});
}

Model::Model(Mesh mesh, const ModelOptions& options)
    : data_(std::make_shared<const ModelData>(std::move(mesh), options)) {}
Model::Model(std::shared_ptr<const ModelData> data) : data_(std::move(data)) {}
const Mesh& Model::mesh() const noexcept {
    return data_->mesh();
}
std::size_t Model::bytes() const noexcept {
    return data_->bytes();
}

const char* to_string(Volume volume) {
    constexpr std::array kNames{"automatic", "aabb", "sphere", "kdop14", "kdop18", "kdop26",
                                "obb",       "pss",  "lss",    "rss",    "ssv"};
    return kNames.at(static_cast<std::size_t>(volume));
}

} // namespace abut
