#pragma once

#include "tree/obb_tree.h"

#include <cstdint>

namespace abut {

/// Which nodes of a tree get their own axes.
enum class OwnAxes : std::uint8_t {
    never,
    where_smaller, ///< where they make the children's boxes smaller
    where_turned,  ///< where the node's frame is already marked as turned
};

/// Fills the leaves of a tree in the tree's axes.
///
/// In          the tree's order is set.
void fill_leaves(Tree& tree, const TreeMesh& mesh);

/// Sets frames, boxes and bounds of the nodes of a triangle tree, and transforms the leaves to
/// their node's frame.
///
/// In          children and order are set; leaves and the children's boxes are in the tree's axes.
/// Cost        O(n log n), in parallel.
void orient_nodes(Tree& tree, const TreeMesh& mesh, OwnAxes own_axes);

} // namespace abut
