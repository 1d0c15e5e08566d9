#pragma once

#include "tree/tree.h"

#include <cstdint>

namespace abut {

/// Which nodes of a tree get axes of their own.
enum class OwnAxes : std::uint8_t {
    never,
    where_smaller, ///< where they make the children's boxes smaller
    where_turned,  ///< where the node's frame says that it is turned: it is known
};

/// Fills the leaves of a tree, in the tree's axes.
///
/// In          the tree's order.
void fill_leaves(Tree& tree, const TreeMesh& mesh);

/// Gives the nodes of a tree of triangles their frames, boxes and bounds, and turns the leaves.
///
/// In          the tree's children and order, its leaves and the children's boxes in the tree's axes.
/// Cost        O(n log n); in parallel.
void orient_nodes(Tree& tree, const TreeMesh& mesh, OwnAxes own_axes);

} // namespace abut
