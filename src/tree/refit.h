#pragma once

#include "core/parallel.h"
#include "tree/tree.h"

#include <cstddef>
#include <cstdint>

namespace abut {

namespace refit_detail {

inline void set_box(Node& node, std::size_t lane, const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis][lane] = box.lower[axis];
        node.upper[axis][lane] = box.upper[axis];
    }
}

} // namespace refit_detail

/// Gives the nodes of a tree of boxes new boxes: those of its leaves, which `leaf_box(ref)` returns,
/// and what encloses them. It is called from any thread.
///
/// Cost        O(n), the leaves in parallel.
template <typename LeafBox>
void refit(Tree& tree, const LeafBox& leaf_box) {
    parallel_for(tree.nodes.size(), 256, [&](std::size_t i) {
        Node& node = tree.nodes[i];
        for (std::size_t lane = 0; lane < Node::kWidth && !node.child[lane].is_none(); ++lane)
            if (node.child[lane].is_leaf())
                refit_detail::set_box(node, lane, leaf_box(node.child[lane]));
    });
    // A node comes after the one above it.
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        Node& node = tree.nodes[i];
        node.bounds = {};
        for (std::size_t lane = 0; lane < Node::kWidth && !node.child[lane].is_none(); ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_leaf())
                refit_detail::set_box(node, lane, tree.nodes[child.index()].bounds);
            node.bounds.merge(node.box(lane));
        }
    }
    if (!tree.empty())
        tree.bounds = tree.nodes[0].bounds;
}

} // namespace abut
