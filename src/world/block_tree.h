#pragma once

#include <abut/types.h>

#include "world/box_block.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A tree over boxes that move. Level 0 is blocks of 16 boxes, in an order that keeps neighbours
/// together; lane i of block b at level k + 1 bounds block 16 b + i of level k. The last level is one
/// block. No links are stored.
///
/// Every lane carries a mark: that its box, or one below it, has changed since the last step.
class BlockTree {
public:
    static constexpr std::size_t kWidth = BoxBlock::kWidth;

    struct Level {
        std::vector<BoxBlock> blocks;
        std::vector<std::uint32_t> marks; ///< bit i: of lane i
    };

    /// Orders the boxes and fits all blocks. All are marked.
    void build(std::span<const Box3> boxes);
    /// Fits the blocks of boxes that have changed or are new, and marks them; but where all have changed
    /// so much that the tree is worn by this step alone, it only becomes worn.
    void refit(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);

    /// Whether it pays to build anew before the next pairs are found: blocks have grown so much
    /// since then that the pairs of them too many, summed over the steps, outweigh it.
    [[nodiscard]] bool is_worn() const;

    [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
    /// The box in a lane of level 0.
    [[nodiscard]] std::uint32_t box_at(std::size_t block, std::size_t lane) const {
        return order_[block * kWidth + lane];
    }
    [[nodiscard]] std::size_t size() const { return order_.size(); }

private:
    void resize_levels();
    void append(std::size_t count);
    void refit_all(std::span<const Box3> boxes);
    void refit_some(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);
    void fit_block(std::span<const Box3> boxes, std::size_t block);
    void fit_parents(std::size_t level);
    void forget_marks();
    void mark(std::span<const std::uint32_t> changed);
    /// Pairs of a block too many, with these bounds.
    [[nodiscard]] double excess(std::size_t block, const Aabb& bounds) const;
    void add_wear();
    /// About what `add_wear` will add if all boxes have changed; fits some blocks.
    double sampled_wear(std::span<const Box3> boxes);
    [[nodiscard]] double most_wear() const;

    NarrowFrame frame_;
    std::vector<std::uint32_t> order_; ///< lane of level 0 -> box
    std::vector<std::uint32_t> lane_;  ///< box -> lane of level 0
    std::vector<Level> levels_;
    std::vector<float> built_size_; ///< of each block of level 0 when it was built
    double wear_ = 0;               ///< pairs of blocks too many, over the steps since
};

} // namespace abut
