#include "walk/box_tree.h"

#include "world/broad_phase/median_order.h"

namespace abut {

namespace {

bool is_empty(const Aabb& box) {
    return !(box.lower[0] <= box.upper[0] && box.lower[1] <= box.upper[1] &&
             box.lower[2] <= box.upper[2]);
}

Middle middle_of(const Aabb& box, std::uint32_t index) {
    Middle middle{{}, index};
    for (std::size_t axis = 0; axis < 3; ++axis)
        middle.point[axis] = 0.5F * box.lower[axis] + 0.5F * box.upper[axis];
    return middle;
}

} // namespace

std::vector<std::uint32_t> BoxTree::build(std::span<const Aabb> boxes) {
    std::vector<std::uint32_t> order(boxes.size());
    {
        std::vector<Middle> middles;
        middles.reserve(boxes.size());
        std::size_t last = boxes.size(); // empty boxes are placed last
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (is_empty(boxes[i]))
                order[--last] = i;
            else
                middles.push_back(middle_of(boxes[i], i));
        order_by_medians(middles);
        std::transform(middles.begin(), middles.end(), order.begin(),
                       [](const Middle& middle) { return middle.box; });
    }
    size_ = boxes.size();
    levels_.clear();
    BoxNode empty{};
    for (std::size_t lane = 0; lane < kWidth; ++lane)
        empty.set(lane, Aabb());
    levels_.emplace_back(std::max<std::size_t>((size_ + kWidth - 1) / kWidth, 1), empty);
    for (std::size_t lane = 0; lane < size_; ++lane)
        levels_[0][lane / kWidth].set(lane % kWidth,
                                      is_empty(boxes[order[lane]]) ? Aabb() : boxes[order[lane]]);
    while (levels_.back().size() > 1) {
        const std::vector<BoxNode>& below = levels_.back();
        std::vector<BoxNode> level((below.size() + kWidth - 1) / kWidth, empty);
        for (std::size_t block = 0; block < below.size(); ++block)
            level[block / kWidth].set(block % kWidth, below[block].bounds());
        levels_.push_back(std::move(level));
    }
    return order;
}

void BoxTree::set(std::uint32_t lane, const Aabb& box) {
    Aabb bounds = is_empty(box) ? Aabb() : box;
    for (std::vector<BoxNode>& level : levels_) {
        level[lane / kWidth].set(lane % kWidth, bounds);
        lane /= kWidth;
        bounds = level[lane].bounds();
    }
}

std::size_t BoxTree::bytes() const {
    std::size_t blocks = 0;
    for (const std::vector<BoxNode>& level : levels_)
        blocks += level.capacity();
    return blocks * sizeof(BoxNode);
}

} // namespace abut
