#include "deform/leaf_features.h"

namespace abut {

namespace {

std::vector<NodeRef> leaves_of(const Tree& tree) {
    std::vector<NodeRef> leaves(tree.order.size() / TriangleLeaf::kLanes);
    for (const Node& node : tree.nodes)
        for (const NodeRef child : node.child)
            if (!child.is_none() && child.is_leaf())
                leaves[leaf_number(child)] = child;
    return leaves;
}

MovingBox merged(const MovingBox& a, const MovingBox& b) {
    MovingBox box = a;
    box.merge(b);
    return box;
}

/// Gives each feature of a leaf the box that `box_of(id)` returns.
template <typename BoxOf>
void fit(FeatureRuns& runs, std::uint32_t leaf, const BoxOf& box_of) {
    for (std::uint32_t k = 0; k < runs.count(leaf); ++k)
        runs.set_box(leaf, k, box_of(runs.ids(leaf)[k]));
}

} // namespace

LeafFeatures::LeafFeatures(const Tree& tree, const SurfaceView& surface,
                           std::span<const Represented> represented) {
    for (const NodeRef leaf : leaves_of(tree)) {
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
    for (FeatureRuns* runs : {&faces, &edges, &vertices})
        runs->allocate_boxes();
}

MovingBox fit_leaf(LeafFeatures& leaves, std::uint32_t leaf, const SurfaceView& surface,
                   std::span<const MovingBox> vertex_boxes) {
    MovingBox box;
    fit(leaves.faces, leaf, [&](std::uint32_t id) {
        const auto& [a, b, c] = surface.triangles[id];
        const MovingBox face = merged(merged(vertex_boxes[a], vertex_boxes[b]), vertex_boxes[c]);
        box.merge(face);
        return face;
    });
    fit(leaves.edges, leaf, [&](std::uint32_t id) {
        const auto& [a, b] = surface.features.edges[id];
        return merged(vertex_boxes[a], vertex_boxes[b]);
    });
    fit(leaves.vertices, leaf, [&](std::uint32_t id) { return vertex_boxes[id]; });
    return box;
}

} // namespace abut
