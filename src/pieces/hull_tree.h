#pragma once

#include "convex/hull/polytope.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of one convex piece, or of all pieces below a node.
struct HullNode {
    static constexpr std::uint32_t kLeaf = 0xffffffffU;

    Polytope hull;
    Vec3 middle; ///< no point of the pieces below is farther than `radius` from it
    double radius = 0;
    double inner_radius = 0; ///< of a piece: radius of a ball in its hull; 0 if the hull is flat
    bool is_flat = false;    ///< of a piece: it lies in a plane
    bool is_sheet = false;   ///< of a piece: it is flat, and its triangles cover its hull
    double loss = 0;         ///< largest distance outside the hull of a vertex of a piece below
    std::uint32_t child = kLeaf; ///< the first of consecutive children; kLeaf: a piece
    std::uint32_t children = 0;
    std::uint32_t piece = 0; ///< of a leaf

    [[nodiscard]] bool is_leaf() const { return child == kLeaf; }
};

/// A hierarchy of hulls over convex pieces, with up to four children a node. Immutable once built.
struct HullTree {
    std::vector<HullNode> nodes;        ///< the root first
    std::vector<std::uint32_t> leaf_of; ///< by piece
    /// By piece: the number of the position of each vertex of its hull.
    std::vector<std::vector<std::uint32_t>> sources;
    std::vector<std::uint32_t> leaf_at; ///< by vertex of the root's hull: a leaf with that vertex

    [[nodiscard]] std::size_t bytes() const;
};

/// In          `vertices`: numbers of positions, for each piece; at least one piece and one vertex.
/// Accuracy    exact hulls of the vertices, without those that lie within 2^-46 of the largest
///             coordinate of the hull of the others. A node's hull holds its children's, up to its
///             `loss`.
/// Cost        O(n log n) for each level.
/// Source      [Ehmann, Lin 2001]. Differs: top down, split by the surface area of boxes.
HullTree build_hull_tree(std::span<const Vec3> positions,
                         const std::vector<std::vector<std::uint32_t>>& vertices);

} // namespace abut
