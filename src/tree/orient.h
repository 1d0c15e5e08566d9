#pragma once

#include "tree/tree.h"

namespace abut {

/// Gives the nodes of a tree of triangles their frames, boxes and bounds, and fills the leaves.
///
/// In          the tree's children and order.
/// Cost        O(n log n); in parallel.
void orient_nodes(Tree& tree, const TreeMesh& mesh);

} // namespace abut
