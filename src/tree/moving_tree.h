#pragma once

#include "core/parallel.h"
#include "tree/obb_tree.h"
#include "volume/moving_box.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A node with eight children, stored as moving boxes: row r of lane i is rows[r][i] (see
/// MovingBoxRun). Unused lanes come last. Their boxes are empty and their references are none.
struct alignas(32) MovingNode {
    static constexpr std::uint32_t kWidth = Node::kWidth;
    float rows[MovingBoxRun::kRows][kWidth];
    NodeRef child[kWidth];

    /// The boxes without ids: children have none.
    [[nodiscard]] MovingBoxRun boxes() const { return {&rows[0][0], nullptr, kWidth}; }
};

/// Hierarchy over moving boxes, eight wide. Its topology stays the same while the boxes change.
struct MovingTree {
    std::vector<MovingNode> nodes; ///< nodes[0] is the root; a node comes after its parent

    MovingTree() = default;
    /// Takes the topology of a tree. All boxes are empty until `fit`.
    explicit MovingTree(const Tree& shape);

    [[nodiscard]] bool empty() const { return nodes.empty(); }
    [[nodiscard]] NodeRef named(std::uint32_t name) const {
        return name == kRootName ? NodeRef::node(0) : nodes[node_of(name)].child[lane_of(name)];
    }
    [[nodiscard]] std::size_t bytes() const { return nodes.size() * sizeof(nodes[0]); }
};

/// The number of a leaf: leaves are numbered in the order of their slots.
inline std::uint32_t leaf_number(NodeRef leaf) {
    return leaf.first() / TriangleLeaf::kLanes;
}

/// Sets the boxes of all leaves at one end of the motion, and refits the nodes above.
/// `leaf_box(number)` returns a leaf's box; it may be called from any thread.
///
/// Cost        O(n), the leaves in parallel.
template <typename LeafBox>
void fit(MovingTree& tree, StepEnd end, const LeafBox& leaf_box);

namespace moving_tree {

void set_box(MovingNode& node, std::size_t lane, StepEnd end, const Aabb& box);
MovingBox box_of(const MovingNode& node, std::size_t lane);
/// The box that encloses all children of a node.
MovingBox bounds_of(const MovingNode& node);
/// Refits the boxes of inner children from the nodes below.
void fit_inner(MovingTree& tree, StepEnd end);

} // namespace moving_tree

template <typename LeafBox>
void fit(MovingTree& tree, StepEnd end, const LeafBox& leaf_box) {
    parallel_for(tree.nodes.size(), 256, [&](std::size_t i) {
        MovingNode& node = tree.nodes[i];
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane)
            if (!node.child[lane].is_none() && node.child[lane].is_leaf())
                moving_tree::set_box(node, lane, end, leaf_box(leaf_number(node.child[lane])));
    });
    moving_tree::fit_inner(tree, end);
}

} // namespace abut
