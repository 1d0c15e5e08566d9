#include "world/broad_phase/moving_box_tree.h"

#include "core/parallel.h"
#include "simd/simd.h"
#include "world/broad_phase/changed_lanes.h"
#include "world/broad_phase/median_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

constexpr std::size_t kMovingNodesOfTask = 256;

/// Prefetches both cache lines that a box may lie in.
void prefetch(const Box3* box) {
    hwy::Prefetch(&box->lower);
    hwy::Prefetch(&box->upper.z);
}

/// Sum of the edge lengths; 0 if the box is empty.
float size_of(const Aabb& box) {
    float size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        size += std::max(0.0F, box.upper[axis] - box.lower[axis]);
    return size;
}

} // namespace

void MovingBoxTree::build(std::span<const Box3> boxes) {
    frame_ = NarrowFrame::about(boxes);
    order_ = median_order(boxes.size(), [&](std::uint32_t i) { return frame_.narrow(boxes[i]); });
    lane_.resize(boxes.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i)
        lane_[order_[i]] = i;
    resize_levels();
    refit_all(boxes);
    mark(order_);
    built_size_.resize(levels_[0].size());
    for (std::size_t i = 0; i < built_size_.size(); ++i)
        built_size_[i] = size_of(levels_[0][i].bounds());
    wear_ = 0;
    usual_ = {};
}

void MovingBoxTree::refit(std::span<const Box3> boxes, std::span<const std::uint32_t> changed) {
    if (boxes.size() > order_.size())
        append(boxes.size());
    if (changed.size() == order_.size() && sampled_wear(boxes) > most_wear()) {
        wear_ = 2 * most_wear();
        return;
    }
    // If many boxes have changed, it is cheaper to go through all nodes in order.
    constexpr std::size_t kFew = 16;
    if (changed.size() * kFew > order_.size()) {
        refit_all(boxes);
        mark(changed);
    } else {
        refit_some(boxes, changed);
    }
    add_wear();
}

void MovingBoxTree::resize_levels() {
    levels_.resize(order_.size());
    marks_.resize(levels_.count());
    for (std::size_t level = 0; level < levels_.count(); ++level)
        marks_[level].resize(levels_[level].size(), 0);
}

void MovingBoxTree::append(std::size_t count) {
    const std::size_t old = order_.size();
    order_.resize(count), lane_.resize(count);
    std::iota(order_.begin() + static_cast<std::ptrdiff_t>(old), order_.end(),
              static_cast<std::uint32_t>(old));
    std::iota(lane_.begin() + static_cast<std::ptrdiff_t>(old), lane_.end(),
              static_cast<std::uint32_t>(old));
    const std::size_t levels = levels_.count();
    resize_levels();
    if (levels_.count() != levels) // a new root must take over the bounds of the old one
        levels_.fit();
    built_size_.resize(levels_[0].size(), 0);
}

void MovingBoxTree::fit_node(std::span<const Box3> boxes, std::size_t node) {
    BoxNode& to = levels_[0][node];
    const std::size_t first = node * kWidth, ahead = first + 2 * kWidth;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
        // Neighbours in space are not neighbours in memory.
        if (ahead + lane < order_.size())
            prefetch(&boxes[order_[ahead + lane]]);
        to.set(lane,
               first + lane < order_.size() ? frame_.narrow(boxes[order_[first + lane]]) : Aabb());
    }
}

void MovingBoxTree::refit_all(std::span<const Box3> boxes) {
    parallel_for(levels_[0].size(), kMovingNodesOfTask,
                 [&](std::size_t node) { fit_node(boxes, node); });
    levels_.fit();
}

void MovingBoxTree::refit_some(std::span<const Box3> boxes,
                               std::span<const std::uint32_t> changed) {
    forget_marks();
    std::vector<std::size_t> lanes, parents;
    lanes.reserve(changed.size());
    for (const std::uint32_t box : changed) {
        lanes.push_back(lane_[box]);
        levels_[0][lane_[box] / kWidth].set(lane_[box] % kWidth, frame_.narrow(boxes[box]));
    }
    for (std::size_t level = 0; level < levels_.count(); ++level) {
        parents.clear();
        for (const std::size_t lane : lanes) {
            std::uint32_t& marks = marks_[level][lane / kWidth];
            if (marks == 0)
                parents.push_back(lane / kWidth);
            marks |= 1U << lane % kWidth;
        }
        if (level + 1 < levels_.count())
            for (const std::size_t node : parents)
                levels_[level + 1][node / kWidth].set(node % kWidth, levels_[level][node].bounds());
        std::swap(lanes, parents);
    }
}

void MovingBoxTree::move(std::uint32_t box, const Box3& before, const Box3& now,
                         std::vector<std::size_t>& lanes) {
    const Aabb to = frame_.narrow(now);
    add_wear_of_move(find_changed_lanes(levels_, frame_.narrow(before), to, lanes));
    levels_.set(lane_[box], to);
}

void MovingBoxTree::forget_marks() {
    for (std::vector<std::uint32_t>& marks : marks_)
        std::fill(marks.begin(), marks.end(), 0);
}

void MovingBoxTree::mark(std::span<const std::uint32_t> changed) {
    if (changed.size() == order_.size()) {
        for (std::vector<std::uint32_t>& marks : marks_)
            std::fill(marks.begin(), marks.end(), BoxNode::kAllLanes);
        return;
    }
    forget_marks();
    for (const std::uint32_t box : changed)
        marks_[0][lane_[box] / kWidth] |= 1U << lane_[box] % kWidth;
    for (std::size_t level = 1; level < levels_.count(); ++level)
        for (std::size_t child = 0; child < marks_[level - 1].size(); ++child)
            if (marks_[level - 1][child] != 0)
                marks_[level][child / kWidth] |= 1U << child % kWidth;
}

double MovingBoxTree::excess(std::size_t node, const Aabb& bounds) const {
    const float size = size_of(bounds);
    if (!(size > built_size_[node]))
        return 0;
    // The number of additional node pairs is about proportional to the additional volume.
    const auto most = static_cast<float>(built_size_.size());
    const float growth = built_size_[node] > 0 ? size / built_size_[node] : most;
    return double{std::min(growth * growth * growth, most)} - 1;
}

void MovingBoxTree::add_wear() {
    if (levels_.count() < 2)
        return;
    for (std::size_t node = 0; node < built_size_.size(); ++node)
        if (marks_[0][node] != 0)
            wear_ += excess(node, levels_[1][node / kWidth].box(node % kWidth));
}

double MovingBoxTree::sampled_wear(std::span<const Box3> boxes) {
    constexpr std::size_t kStride = 16;
    if (levels_.count() < 2)
        return 0;
    double sum = 0;
    for (std::size_t node = 0; node < built_size_.size(); node += kStride) {
        fit_node(boxes, node);
        sum += excess(node, levels_[0][node].bounds());
    }
    return sum * kStride;
}

void MovingBoxTree::add_wear_of_move(std::size_t nodes) {
    constexpr std::size_t kEnough = 64;
    if (usual_.moves < kEnough) {
        ++usual_.moves;
        usual_.nodes += nodes;
        return;
    }
    // Testing one box against a node takes about this share of testing sixteen.
    constexpr double kPairsOfNodes = 0.15;
    wear_ += kPairsOfNodes *
             (static_cast<double>(nodes) - static_cast<double>(usual_.nodes) / double{kEnough});
}

double MovingBoxTree::most_wear() const {
    // Ordering the boxes of a node takes about as long as testing it against this many others.
    constexpr double kBoxNodePairsOfBuild = 12;
    return kBoxNodePairsOfBuild * static_cast<double>(built_size_.size());
}

bool MovingBoxTree::is_worn() const {
    return wear_ > most_wear();
}

} // namespace abut
