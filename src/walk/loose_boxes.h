#pragma once

#include "walk/box_tree.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut {

/// Boxes that come, move and go: few beside those that stay, in a tree of their own. Fitted again where
/// they move, built again after as many moves as there are boxes, and when some come or go.
class LooseBoxes {
public:
    void put(std::uint32_t entry, const Aabb& box);
    void erase(std::uint32_t entry);

    /// Up to date.
    const BoxTree& tree();
    [[nodiscard]] std::uint32_t entry(std::uint32_t lane) const { return entries_[order_[lane]]; }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    /// About: also what the tree will take once it is built.
    [[nodiscard]] std::size_t bytes() const { return 160 * entries_.size(); }

private:
    std::vector<std::uint32_t> entries_;
    std::vector<Aabb> boxes_;
    std::unordered_map<std::uint32_t, std::uint32_t> places_; ///< of entries in these lists
    BoxTree tree_;
    std::vector<std::uint32_t> order_, lanes_; ///< lane -> place, and back
    std::size_t moves_ = 0;                    ///< since it was built
    bool stale_ = false;                       ///< some have come or gone since
};

} // namespace abut
