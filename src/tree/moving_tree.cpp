#include "tree/moving_tree.h"

#include <algorithm>

namespace abut {

MovingTree::MovingTree(const Tree& shape) : nodes(shape.nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            nodes[i].child[lane] = shape.nodes[i].child[lane];
            for (const StepEnd end : kStepEnds)
                moving_tree::set_box(nodes[i], lane, end, {});
        }
}

namespace moving_tree {

namespace {

Aabb bounds_of(const MovingNode& node, StepEnd end) {
    Aabb box;
    const auto* row = node.rows + (end == StepEnd::start ? 0 : MovingBoxRun::kEnd);
    for (float& bound : box.lower) {
        bound = *std::min_element(*row, *row + MovingNode::kWidth);
        ++row;
    }
    for (float& bound : box.upper) {
        bound = *std::max_element(*row, *row + MovingNode::kWidth);
        ++row;
    }
    return box;
}

} // namespace

void set_box(MovingNode& node, std::size_t lane, StepEnd end, const Aabb& box) {
    set_bounds(&node.rows[0][0] + first_bound(end, MovingNode::kWidth, lane), MovingNode::kWidth,
               box);
}

MovingBox box_of(const MovingNode& node, std::size_t lane) {
    const auto at = [&](StepEnd end) {
        return bounds_from(&node.rows[0][0] + first_bound(end, MovingNode::kWidth, lane),
                           MovingNode::kWidth);
    };
    return {at(StepEnd::start), at(StepEnd::end)};
}

MovingBox bounds_of(const MovingNode& node) {
    return {bounds_of(node, StepEnd::start), bounds_of(node, StepEnd::end)};
}

void fit_inner(MovingTree& tree, StepEnd end) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        MovingNode& node = tree.nodes[i];
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_none() && !child.is_leaf())
                set_box(node, lane, end, bounds_of(tree.nodes[child.index()], end));
        }
    }
}

} // namespace moving_tree
} // namespace abut
