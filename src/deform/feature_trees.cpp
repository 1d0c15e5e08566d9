#include "deform/feature_trees.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace abut {

namespace {

/// Calls visit(tree, box_of(id)) for each kind of feature.
template <typename Visit>
void for_each_kind(FeatureTrees& trees, const SurfaceView& surface,
                   std::span<const Aabb> vertex_boxes, const Visit& visit) {
    visit(trees.faces, [&](std::size_t id) { return box_of(surface.triangles[id], vertex_boxes); });
    visit(trees.edges,
          [&](std::size_t id) { return box_of(surface.features.edges[id], vertex_boxes); });
    visit(trees.vertices, [&](std::size_t id) { return vertex_boxes[id]; });
}

std::vector<std::uint32_t> first_numbers(std::size_t count) {
    std::vector<std::uint32_t> ids(count);
    std::iota(ids.begin(), ids.end(), 0U);
    return ids;
}

std::vector<std::uint32_t> used_vertices(const SurfaceView& surface) {
    std::vector<bool> used(surface.vertices);
    for (const IndexTriangle& triangle : surface.triangles)
        for (const std::uint32_t v : triangle)
            used[v] = true;
    std::vector<std::uint32_t> ids;
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (used[v])
            ids.push_back(v);
    return ids;
}

template <typename BoxOf>
void build(FeatureTree& tree, const std::vector<std::uint32_t>& ids, const BoxOf& box_of) {
    std::vector<Aabb> boxes;
    boxes.reserve(ids.size());
    for (const std::uint32_t id : ids)
        boxes.push_back(box_of(id));
    const Tree shape = build_tree(boxes);
    tree.tree = MovingTree(shape);
    for (const NodeRef leaf : leaves_of(shape)) {
        for (std::uint32_t i = 0; i < leaf.count(); ++i)
            tree.runs.add(ids[shape.order[leaf.first() + i]]);
        tree.runs.end_leaf();
    }
    tree.runs.allocate_boxes();
}

} // namespace

FeatureTrees::FeatureTrees(const SurfaceView& surface, std::span<const Aabb> vertex_boxes) {
    for_each_kind(*this, surface, vertex_boxes, [&](FeatureTree& tree, const auto& box_of) {
        build(tree,
              &tree == &vertices ? used_vertices(surface)
                                 : first_numbers(&tree == &edges ? surface.features.edges.size()
                                                                 : surface.triangles.size()),
              box_of);
    });
}

void FeatureTrees::fit(const SurfaceView& surface, StepEnd end,
                       std::span<const Aabb> vertex_boxes) {
    for_each_kind(*this, surface, vertex_boxes, [&](FeatureTree& tree, const auto& box_of) {
        abut::fit(tree.tree, end,
                  [&](std::uint32_t leaf) { return fit_run(tree.runs, leaf, end, box_of); });
    });
}

} // namespace abut
