#include "tree/moving_tree.h"

#include <algorithm>

namespace abut {

MovingTree::MovingTree(const Tree& shape) : nodes(shape.nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            nodes[i].child[lane] = shape.nodes[i].child[lane];
            moving_tree::set_box(nodes[i], lane, {});
        }
}

namespace moving_tree {

void set_box(MovingNode& node, std::size_t lane, const MovingBox& box) {
    std::size_t row = 0;
    for (const Aabb& end : {box.start, box.end})
        for (const auto& side : {end.lower, end.upper})
            for (const float bound : side)
                node.rows[row++][lane] = bound;
}

MovingBox box_of(const MovingNode& node, std::size_t lane) {
    MovingBox box;
    std::size_t row = 0;
    for (Aabb* end : {&box.start, &box.end})
        for (auto* side : {&end->lower, &end->upper})
            for (float& bound : *side)
                bound = node.rows[row++][lane];
    return box;
}

MovingBox bounds_of(const MovingNode& node) {
    MovingBox box;
    std::size_t row = 0;
    for (Aabb* end : {&box.start, &box.end}) {
        for (float& bound : end->lower) {
            bound = *std::min_element(node.rows[row], node.rows[row] + MovingNode::kWidth);
            ++row;
        }
        for (float& bound : end->upper) {
            bound = *std::max_element(node.rows[row], node.rows[row] + MovingNode::kWidth);
            ++row;
        }
    }
    return box;
}

void fit_inner(MovingTree& tree) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        MovingNode& node = tree.nodes[i];
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_none() && !child.is_leaf())
                set_box(node, lane, bounds_of(tree.nodes[child.index()]));
        }
    }
}

} // namespace moving_tree
} // namespace abut
