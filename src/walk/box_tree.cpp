#include "walk/box_tree.h"

#include "world/broad_phase/median_order.h"

namespace abut {

std::vector<std::uint32_t> BoxTree::build(std::span<const Aabb> boxes) {
    std::vector<std::uint32_t> order =
        median_order(boxes.size(), [&](std::uint32_t i) { return boxes[i]; });
    size_ = boxes.size();
    levels_ = {};
    levels_.resize(size_);
    for (std::size_t lane = 0; lane < size_ && !is_empty(boxes[order[lane]]); ++lane)
        levels_[0][lane / kWidth].set(lane % kWidth, boxes[order[lane]]);
    levels_.fit();
    return order;
}

void BoxTree::set(std::uint32_t lane, const Aabb& box) {
    levels_.set(lane, is_empty(box) ? Aabb() : box);
}

} // namespace abut
