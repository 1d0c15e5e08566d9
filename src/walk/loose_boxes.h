#pragma once

#include "walk/box_tree.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut {

/// The boxes of entries that were added or moved, in a tree of their own. They are few compared
/// with the boxes that stay. The tree is refitted when a box moves. It is rebuilt when boxes were
/// added or erased, or when there were more moves than boxes.
class LooseBoxes {
public:
    void put(std::uint32_t entry, const Aabb& box);
    void erase(std::uint32_t entry);

    /// Returns the tree; rebuilds it first if needed.
    const BoxTree& tree();
    [[nodiscard]] std::uint32_t entry(std::uint32_t lane) const { return entries_[order_[lane]]; }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    /// An estimate that includes the tree, even if it is not built yet.
    [[nodiscard]] std::size_t bytes() const { return 160 * entries_.size(); }

private:
    std::vector<std::uint32_t> entries_;
    std::vector<Aabb> boxes_;
    std::unordered_map<std::uint32_t, std::uint32_t> places_; ///< entry -> index in both lists
    BoxTree tree_;
    std::vector<std::uint32_t> order_, lanes_; ///< lane -> index, and back
    std::size_t moves_ = 0;                    ///< since the tree was built
    bool stale_ = false;                       ///< boxes were added or erased since then
};

} // namespace abut
