#include "world/broad_phase/box_levels.h"

#include "core/parallel.h"

#include <algorithm>

namespace abut {

namespace {

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
    for (std::vector<BoxNode>& level : levels_) {
        level[lane / kWidth].set(lane % kWidth, bounds);
        lane /= kWidth;
        bounds = level[lane].bounds();
    }
}

std::size_t BoxLevels::bytes() const {
    std::size_t nodes = 0;
    for (const std::vector<BoxNode>& level : levels_)
        nodes += level.capacity();
    return nodes * sizeof(BoxNode);
}

} // namespace abut
