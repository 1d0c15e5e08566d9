#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// Four triangles of a leaf in single precision. Lane i of every row belongs to triangle i. Unused
/// lanes repeat the first triangle.
struct alignas(16) TriangleLeaf {
    static constexpr std::size_t kLanes = 4;
    float v[3][3][kLanes]; ///< [vertex][axis][lane]
};

/// The transform from leaf b's frame to leaf a's. It has to be filled in: clearing it first would cost
/// as much as filling it.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct LeafPlacement {
    /// Transforms b's points to a's frame: [column][row], padded to four.
    alignas(16) std::array<std::array<float, 4>, 3> linear;
    std::array<float, 4> translation;
    float margin = 0; ///< error bound of the difference of two coordinates, on each axis
};

/// A distance to test against, and a direction along which the leaves may be farther apart than
/// that.
struct LeafBound {
    float bound_sq = 0;               ///< squared distance, in a's frame
    float along_sq = 0;               ///< the same distance, in units of `direction`
    std::array<float, 3> direction{}; ///< in a's frame, from a to b; zero: not used
};

/// Sets of pairs of triangles: bit 4 i + j stands for triangle i of a and triangle j of b.
struct LeafPairs {
    std::uint32_t cross = 0;       ///< their interiors certainly cross transversally
    std::uint32_t may_meet = 0;    ///< undecided: they may share a point
    std::uint32_t may_be_near = 0; ///< in neither set above, but possibly within the bound

    [[nodiscard]] std::uint32_t any() const { return cross | may_meet | may_be_near; }
};

/// The pairs that cross, and those that may share a point.
///
/// Accuracy    certain, whatever the margin: a pair without a bit shares no point.
/// Cost        some 180 operations for all sixteen pairs.
/// Source      [Guigue, Devillers 2003] in floating point with an error bound.
LeafPairs meeting_pairs(const TriangleLeaf& a, const TriangleLeaf& b,
                        const LeafPlacement& a_from_b);

/// The pairs of meeting_pairs, and those that may be at most as far apart as the bound.
///
/// Accuracy    certain: a pair has no bit only if the gap of the boxes, the distance of one
///             triangle to the other's plane, or the gap along the direction certainly exceeds the
///             bound.
LeafPairs near_pairs(const TriangleLeaf& a, const TriangleLeaf& b, const LeafPlacement& a_from_b,
                     const LeafBound& bound);

/// meeting_pairs and near_pairs with one lane: the references for every SIMD target.
LeafPairs meeting_pairs_reference(const TriangleLeaf& a, const TriangleLeaf& b,
                                  const LeafPlacement& a_from_b);
LeafPairs near_pairs_reference(const TriangleLeaf& a, const TriangleLeaf& b,
                               const LeafPlacement& a_from_b, const LeafBound& bound);

} // namespace abut
