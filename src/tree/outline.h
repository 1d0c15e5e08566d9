#pragma once

#include "tree/tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// What is dear to find of a tree of triangles, and small to keep: which triangles lie together, and
/// which nodes have axes of their own. All else follows from this and the mesh in linear time.
struct TreeOutline {
    /// Counts what the builder makes of the same mesh: one more whenever it cuts, orders or turns
    /// otherwise. An outline of another format is no use.
    static constexpr std::uint32_t kFormat = 1;

    /// Of each node, depth first:
    ///
    ///     bit  24          23..21 … 2..0
    ///          own axes?   children 7 … 0: 0 none, 1 to 4 a leaf of so many triangles, 5 a node
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> order; ///< triangles, leaf by leaf as a walk depth first meets them

    friend bool operator==(const TreeOutline&, const TreeOutline&) = default;
};

/// In          a tree of triangles, as build_tree makes it.
TreeOutline outline_of(const Tree& tree);

/// Whether build_tree takes the outline for a mesh of so many triangles. What it makes of one that
/// passes is a sound tree, wherever the outline comes from: at worst a slow one.
bool is_outline(const TreeOutline& outline, std::size_t triangles);

/// The tree that the outline was taken of, bit for bit, if the mesh is the same.
///
/// In          outline: passes is_outline.
/// Cost        O(n) and the leaves' share of build_tree's; in parallel. Some 40 % of the time of
///             building (docs/decisions/0020).
Tree build_tree(const TreeMesh& mesh, const TreeOutline& outline);

} // namespace abut
