#pragma once

#include "view/levels/level_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace abut {

/// Something that can be drawn in place of a part of a model: the chunk of a node, or one level of
/// the mesh of an instance.
struct ViewItem {
    std::uint32_t node = 0;
    std::uint32_t level = 0; ///< of a node with an instance: 0 is the coarsest level of the mesh
};

/// A tree of levels as one tree of items: the finer levels of an instance follow each other like a
/// node and its only child.
class ViewItems {
public:
    explicit ViewItems(const LevelTree& tree) : tree_(&tree) {}

    [[nodiscard]] const LevelTree& tree() const { return *tree_; }
    [[nodiscard]] const LevelNode& node(ViewItem item) const { return tree_->nodes[item.node]; }
    [[nodiscard]] bool is_instance(ViewItem item) const { return node(item).instance != kNoChunk; }

    [[nodiscard]] std::uint32_t chunk(ViewItem item) const {
        return is_instance(item) ? level(item).chunk : node(item).chunk;
    }
    /// In metres.
    [[nodiscard]] float error(ViewItem item) const {
        return is_instance(item) ? instance(item).scale * level(item).error : node(item).error;
    }
    [[nodiscard]] bool has_finer(ViewItem item) const {
        return is_instance(item) ? item.level + 1 < mesh(item).levels : node(item).children > 0;
    }
    /// Calls visit(child) for what replaces the item.
    template <typename Visit>
    void for_each_finer(ViewItem item, const Visit& visit) const {
        if (is_instance(item)) {
            visit(ViewItem{item.node, item.level + 1});
            return;
        }
        const LevelNode& parent = node(item);
        for (std::uint32_t i = 0; i < parent.children; ++i)
            visit(ViewItem{parent.first_child + i, 0});
    }
    [[nodiscard]] const LevelInstance& instance(ViewItem item) const {
        return tree_->instances[node(item).instance];
    }

private:
    [[nodiscard]] const LevelMesh& mesh(ViewItem item) const {
        return tree_->meshes[instance(item).mesh];
    }
    [[nodiscard]] const MeshLevel& level(ViewItem item) const {
        return tree_->mesh_levels[mesh(item).first_level + item.level];
    }

    const LevelTree* tree_;
};

/// Squared distance from a point to the box of a node; 0 inside.
inline double distance_sq(const LevelNode& node, const std::array<double, 3>& point) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double gap =
            std::max({0.0, node.lower[axis] - point[axis], point[axis] - node.upper[axis]});
        sum += gap * gap;
    }
    return sum;
}

/// Checks that a tree can be walked: all numbers are in range, children come after their parents,
/// boxes and errors are finite.
///
/// Errors      Error{malformed}, naming the store.
void check_level_tree(const LevelTree& tree, const std::string& store);

} // namespace abut
