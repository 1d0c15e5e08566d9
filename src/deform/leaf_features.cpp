#include "deform/leaf_features.h"

namespace abut {

std::vector<NodeRef> leaves_of(const Tree& tree) {
    std::vector<NodeRef> leaves(tree.order.size() / TriangleLeaf::kLanes);
    for (const Node& node : tree.nodes)
        for (const NodeRef child : node.child)
            if (!child.is_none() && child.is_leaf())
                leaves[leaf_number(child)] = child;
    return leaves;
}

LeafFeatures::LeafFeatures(const Tree& tree, const SurfaceView& surface,
                           std::span<const Represented> represented) {
    const std::vector<NodeRef> leaves = leaves_of(tree);
    faces.reserve(leaves.size(), surface.triangles.size());
    edges.reserve(leaves.size(), surface.features.edges.size());
    vertices.reserve(leaves.size(), surface.vertices);
    for (const NodeRef leaf : leaves) {
        for (std::uint32_t slot = leaf.first(); slot < leaf.first() + leaf.count(); ++slot) {
            const std::uint32_t triangle = tree.order[slot];
            faces.add(triangle);
            for (std::size_t k = 0; k < 3; ++k) {
                if (represents_edge(represented[triangle], k))
                    edges.add(surface.features.edges_of[triangle][k]);
                if (represents_vertex(represented[triangle], k))
                    vertices.add(surface.triangles[triangle][k]);
            }
        }
        for (FeatureRuns* runs : {&faces, &edges, &vertices})
            runs->end_leaf();
    }
}

void LeafFeatures::allocate_boxes() {
    for (FeatureRuns* runs : {&faces, &edges, &vertices})
        runs->allocate_boxes();
}

Aabb fit_leaf(LeafFeatures& leaves, std::uint32_t leaf, StepEnd end, const SurfaceView& surface,
              std::span<const Aabb> vertex_boxes) {
    fit_run(leaves.edges, leaf, end,
            [&](std::uint32_t id) { return box_of(surface.features.edges[id], vertex_boxes); });
    fit_run(leaves.vertices, leaf, end, [&](std::uint32_t id) { return vertex_boxes[id]; });
    return fit_run(leaves.faces, leaf, end,
                   [&](std::uint32_t id) { return box_of(surface.triangles[id], vertex_boxes); });
}

} // namespace abut
