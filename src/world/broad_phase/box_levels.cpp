#include "world/broad_phase/box_levels.h"

#include "core/parallel.h"

#include <algorithm>

namespace abut {

namespace {

/// Whether the inner box touches no side of the outer one.
bool is_inside(const Aabb& inner, const Aabb& outer) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        inside = inside && inner.lower[axis] > outer.lower[axis] &&
                 inner.upper[axis] < outer.upper[axis];
    return inside;
}

constexpr std::size_t nodes_over(std::size_t boxes) {
    return (boxes + BoxLevels::kWidth - 1) / BoxLevels::kWidth;
}

} // namespace

void BoxLevels::resize(std::size_t boxes) {
    std::size_t nodes = std::max<std::size_t>(nodes_over(boxes), 1);
    std::size_t count = 1;
    for (std::size_t n = nodes; n > 1; n = nodes_over(n))
        ++count;
    BoxNode empty{};
    for (std::size_t lane = 0; lane < kWidth; ++lane)
        empty.set(lane, Aabb());
    levels_.resize(count);
    for (std::vector<BoxNode>& level : levels_) {
        level.resize(nodes, empty);
        nodes = nodes_over(nodes);
    }
}

void BoxLevels::fit() {
    constexpr std::size_t kNodesOfTask = 256;
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const std::vector<BoxNode>& children = levels_[level - 1];
        parallel_for(levels_[level].size(), kNodesOfTask, [&](std::size_t node) {
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                const std::size_t child = node * kWidth + lane;
                levels_[level][node].set(lane, child < children.size() ? children[child].bounds()
                                                                       : Aabb());
            }
        });
    }
}

void BoxLevels::set(std::size_t lane, const Aabb& box) {
    Aabb bounds = box;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        const std::size_t node = lane / kWidth;
        const Aabb before = levels_[level][node].box(lane % kWidth);
        levels_[level][node].set(lane % kWidth, bounds);
        if (level + 1 == levels_.size())
            return;
        const Aabb all = levels_[level + 1][node / kWidth].box(node % kWidth);
        if (is_inside(before, all) && is_inside(bounds, all))
            return;
        bounds = levels_[level][node].bounds();
        lane = node;
    }
}

std::size_t BoxLevels::bytes() const {
    std::size_t nodes = 0;
    for (const std::vector<BoxNode>& level : levels_)
        nodes += level.capacity();
    return nodes * sizeof(BoxNode);
}

} // namespace abut
