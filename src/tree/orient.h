#pragma once

#include "tree/tree.h"

namespace abut {

/// Gives the nodes of a tree of triangles their frames, boxes and bounds, and fills the leaves.
///
/// In          the tree's children and order; `own_axes` false: all nodes keep the tree's axes.
/// Cost        O(n log n); in parallel.
void orient_nodes(Tree& tree, const TreeMesh& mesh, bool own_axes);

} // namespace abut
