#pragma once

#include "volume/aabb.h"
#include "world/broad_phase/box_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace abut {

/// A tree that finds near boxes, in an order that keeps neighbours together. Unlike a
/// `MovingBoxTree`, it never compares its boxes with each other, so that it needs no marks.
class BoxTree {
public:
    static constexpr std::uint32_t kWidth = BoxNode::kWidth;

    /// Builds the tree. Returns the index of the box in each lane. An empty box is never found.
    std::vector<std::uint32_t> build(std::span<const Aabb> boxes);
    void set(std::uint32_t lane, const Aabb& box);

    [[nodiscard]] Aabb box(std::uint32_t lane) const {
        return levels_[0][lane / kWidth].box(lane % kWidth);
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return levels_.bytes(); }
    [[nodiscard]] const BoxLevels& levels() const { return levels_; }

private:
    std::size_t size_ = 0;
    BoxLevels levels_;
};

/// A lower bound for each lane of a batch of boxes; infinite for an empty box.
using LaneKeys = std::array<float, BoxNode::kWidth>;

/// Computes lower bounds of the squared distances from one box to a batch of boxes.
struct GapToBox {
    Aabb query;

    [[nodiscard]] LaneKeys operator()(const BoxNode& block) const {
        constexpr float kRounding = 1 - 0x1p-20F;
        LaneKeys keys{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t lane = 0; lane < BoxNode::kWidth; ++lane) {
                const float above = block.lower[axis][lane] - query.upper[axis],
                            below = query.lower[axis] - block.upper[axis][lane];
                const float gap = std::max(0.0F, std::max(above, below));
                keys[lane] += gap * gap;
            }
        for (float& key : keys)
            key *= kRounding;
        return keys;
    }
};

/// Visits the lanes of a tree by ascending key. The key of a batch's bounds must be at most the key
/// of each box in it.
template <typename Metric>
class NearestLanes {
public:
    struct Lane {
        std::uint32_t lane;
        float key;
    };

    NearestLanes(const BoxTree& tree, const Metric& metric) : tree_(tree), metric_(metric) {
        if (tree.size() > 0)
            open(tree.levels().count() - 1, 0);
    }

    /// From now on, lanes whose key exceeds the limit are skipped.
    void set_limit(float key) { limit_ = key; }

    std::optional<Lane> next() {
        while (!queue_.empty() && queue_.top().key <= limit_) {
            const Waiting top = queue_.top();
            queue_.pop();
            if (top.level == 0)
                return Lane{top.index, top.key};
            open(top.level - 1, top.index);
        }
        return std::nullopt;
    }

private:
    struct Waiting {
        float key;
        std::uint32_t level; ///< 0: a box; k: a batch of level k - 1
        std::uint32_t index;
        friend bool operator<(const Waiting& a, const Waiting& b) { return a.key > b.key; }
    };

    void open(std::size_t level, std::uint32_t block) {
        const LaneKeys keys = metric_(tree_.levels()[level][block]);
        for (std::uint32_t lane = 0; lane < BoxTree::kWidth; ++lane)
            if (keys[lane] <= limit_ && keys[lane] < std::numeric_limits<float>::infinity())
                queue_.push({keys[lane], static_cast<std::uint32_t>(level),
                             block * BoxTree::kWidth + lane});
    }

    const BoxTree& tree_;
    Metric metric_;
    float limit_ = std::numeric_limits<float>::infinity();
    std::priority_queue<Waiting> queue_;
};

} // namespace abut
