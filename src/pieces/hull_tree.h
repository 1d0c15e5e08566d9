#pragma once

#include "convex/hull/polytope.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of one piece, or of all that lie below.
struct HullNode {
    static constexpr std::uint32_t kLeaf = 0xffffffffU;

    Polytope hull;
    Vec3 middle; ///< no point of the pieces below is farther than `radius` from here
    double radius = 0;
    double inner_radius = 0; ///< of a piece: its hull holds a ball of this radius; 0 if it is flat
    bool is_flat = false;    ///< of a piece: it lies in a plane
    bool is_sheet = false;   ///< of a piece: flat, and all of its hull is covered by its triangles
    double loss = 0;         ///< no vertex of a piece below lies farther outside of the hull
    std::uint32_t child = kLeaf; ///< the first of some, which follow each other; kLeaf: a piece
    std::uint32_t children = 0;
    std::uint32_t piece = 0; ///< of a leaf

    [[nodiscard]] bool is_leaf() const { return child == kLeaf; }
};

/// A hierarchy of hulls over convex pieces, four children a node. Immutable once built.
struct HullTree {
    std::vector<HullNode> nodes;        ///< the root first
    std::vector<std::uint32_t> leaf_of; ///< by piece
    /// By piece: which of the positions each vertex of its hull is.
    std::vector<std::vector<std::uint32_t>> sources;
    std::vector<std::uint32_t> leaf_at; ///< by vertex of the root's hull: a leaf that has it

    [[nodiscard]] std::size_t bytes() const;
};

/// In          `vertices`: of each piece, numbers of positions; at least one piece and one vertex.
/// Accuracy    exact hulls of the vertices that are left once those are taken out that lie between
///             two others to 2^-46 of the largest coordinate. A parent's hull holds those of its
///             children to its `loss`.
/// Cost        O(n log n) a level.
/// Source      [Ehmann, Lin 2001]. Differs: parted by the surface area of boxes, top down.
HullTree build_hull_tree(std::span<const Vec3> positions,
                         const std::vector<std::vector<std::uint32_t>>& vertices);

} // namespace abut
