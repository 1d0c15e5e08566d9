#pragma once

#include "tree/obb_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// The part of a triangle tree that is expensive to compute and small to store: which triangles lie
/// together, and which nodes have their own axes. The rest of the tree follows from this and the
/// mesh in linear time.
struct TreeOutline {
    /// Version of the builder's result. It is increased whenever the builder cuts, orders or
    /// orients nodes differently. An outline of another version cannot be used.
    static constexpr std::uint32_t kFormat = 1;

    /// A code for each node, depth first:
    ///
    ///     bit  24          23..21 … 2..0
    ///          own axes?   child 7 … 0: 0 none, 1 to 4 a leaf of that many triangles, 5 a node
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> order; ///< triangles, leaf by leaf in depth-first order

    friend bool operator==(const TreeOutline&, const TreeOutline&) = default;
};

/// The outline of a tree.
/// In          a tree of triangles, as build_tree makes it.
TreeOutline outline_of(const Tree& tree);

/// Whether build_tree can use the outline for a mesh of this many triangles. An outline that passes
/// gives a valid tree, wherever the outline comes from. At worst the tree is slow.
bool is_outline(const TreeOutline& outline, std::size_t triangles);

/// Rebuilds the tree from which the outline was taken, bit for bit, if the mesh is the same.
///
/// In          outline: passes is_outline.
/// Cost        O(n), plus the leaves' share of build_tree's cost; in parallel. It takes about 40 %
///             of the time of a build (docs/decisions/0020).
Tree build_tree(const TreeMesh& mesh, const TreeOutline& outline);

} // namespace abut
