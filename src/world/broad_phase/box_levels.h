#pragma once

#include "world/broad_phase/box_node.h"

#include <cstddef>
#include <vector>

namespace abut {

inline bool is_empty(const Aabb& box) {
    return !(box.lower[0] <= box.upper[0] && box.lower[1] <= box.upper[1] &&
             box.lower[2] <= box.upper[2]);
}

/// The nodes of a complete 16-ary tree over boxes in a given order. Level 0 consists of nodes of 16
/// boxes. Lane i of node b at level k + 1 bounds node 16 b + i of level k. The last level is a
/// single node. No links are stored, so that a box takes 26 bytes.
class BoxLevels {
public:
    static constexpr std::size_t kWidth = BoxNode::kWidth;

    /// Changes the number of boxes. Boxes that are new are empty, and nodes that are new are not
    /// fitted.
    void resize(std::size_t boxes);
    /// Fits all levels above level 0.
    void fit();
    /// Changes the box in a lane of level 0, and the bounds of the nodes above it as far as they
    /// change.
    void set(std::size_t lane, const Aabb& box);

    [[nodiscard]] std::size_t count() const { return levels_.size(); }
    [[nodiscard]] std::vector<BoxNode>& operator[](std::size_t level) { return levels_[level]; }
    [[nodiscard]] const std::vector<BoxNode>& operator[](std::size_t level) const {
        return levels_[level];
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    std::vector<std::vector<BoxNode>> levels_;
};

} // namespace abut
