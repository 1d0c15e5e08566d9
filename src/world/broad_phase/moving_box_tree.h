#pragma once

#include <abut/types.h>

#include "world/broad_phase/box_levels.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A tree over moving boxes, in an order that keeps neighbours together.
///
/// Every lane has a mark, which says that its box, or a box below it, has changed since the last
/// step.
class MovingBoxTree {
public:
    static constexpr std::size_t kWidth = BoxNode::kWidth;

    /// Orders the boxes and fits all nodes. All lanes are marked.
    void build(std::span<const Box3> boxes);
    /// Refits the nodes of boxes that have changed or are new, and marks them. If all boxes have
    /// changed so much that this step alone makes the tree worn, the tree only becomes worn.
    void refit(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);

    /// Moves one box, without marks. Appends to `lanes` the lanes of level 0 with which the box may
    /// have begun or ceased to overlap (`find_changed_lanes`).
    void move(std::uint32_t box, const Box3& before, const Box3& now,
              std::vector<std::size_t>& lanes);
    /// The box in a lane of level 0.
    [[nodiscard]] std::uint32_t box_at(std::size_t lane) const { return order_[lane]; }

    /// Whether a rebuild pays before pairs are searched again. Nodes grow after a build and meet
    /// more nodes. The tree is worn when the tests of these additional pairs, summed over the
    /// steps, cost more than a build.
    [[nodiscard]] bool is_worn() const;

    [[nodiscard]] const BoxLevels& levels() const { return levels_; }
    /// The marks of each node of a level: bit i belongs to lane i.
    [[nodiscard]] const std::vector<std::uint32_t>& marks(std::size_t level) const {
        return marks_[level];
    }
    /// The box in a lane of level 0.
    [[nodiscard]] std::uint32_t box_at(std::size_t node, std::size_t lane) const {
        return order_[node * kWidth + lane];
    }
    [[nodiscard]] std::size_t size() const { return order_.size(); }

private:
    void resize_levels();
    void append(std::size_t count);
    void refit_all(std::span<const Box3> boxes);
    void refit_some(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);
    void fit_node(std::span<const Box3> boxes, std::size_t node);
    void forget_marks();
    void mark(std::span<const std::uint32_t> changed);
    /// Number of additional pairs that a node with these bounds meets.
    [[nodiscard]] double excess(std::size_t node, const Aabb& bounds) const;
    void add_wear();
    void add_wear_of_move(std::size_t nodes);
    /// An estimate of what `add_wear` will add if all boxes have changed. Refits some nodes.
    double sampled_wear(std::span<const Box3> boxes);
    [[nodiscard]] double most_wear() const;

    NarrowFrame frame_;
    std::vector<std::uint32_t> order_; ///< lane of level 0 -> box
    std::vector<std::uint32_t> lane_;  ///< box -> lane of level 0
    BoxLevels levels_;
    std::vector<std::vector<std::uint32_t>> marks_; ///< [level][node]
    std::vector<float> built_size_; ///< size of each node of level 0 at the last build
    double wear_ = 0;               ///< additional node pairs, summed over the steps since the
                                    ///< build
    /// Moves of single boxes, and the nodes that they looked at, until there were enough to tell
    /// what a move costs in a tree that is not worn.
    struct {
        std::size_t moves = 0, nodes = 0;
    } usual_;
};

} // namespace abut
