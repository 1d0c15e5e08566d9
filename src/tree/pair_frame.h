#pragma once

#include "geometry/leaf/triangle_leaf.h"
#include "math/transform.h"
#include "tree/obb_tree.h"

#include <array>

namespace abut {

/// Maps the boxes of one node's frame to another's, in single precision. The margin bounds the
/// error: a gap larger than the margin is real.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): as LeafPlacement
struct FrameMap : LeafPlacement {
    alignas(16) std::array<std::array<float, 4>, 3> magnitude; ///< |linear|, for half extents
    float stretch_sq = 0; ///< a squared gap in the target frame, times this, is at most the squared
                          ///< gap in the world
    float most_stretch_sq = 0; ///< a squared distance in the target frame, times this, is at least
                               ///< that in the world
};

/// A direction expressed in a frame: its product with a vector of that frame is the vector's length
/// along the direction in the world.
using Covector = std::array<float, 3>;

/// The map between two trees' frames.
struct TreeMap {
    /// [column][row], padded to four; the last column is the translation.
    std::array<std::array<double, 4>, 4> to_from{};
    std::array<std::array<float, 3>, 3> linear{}; ///< the linear part of to_from: [row][column]
    float margin = 0;     ///< rounding of double precision, on each axis of the target
    float row_sum = 0;    ///< largest sum of a row's magnitudes
    float stretch_sq = 0; ///< see FrameMap
    float most_stretch_sq = 0;
};

/// The frames of two trees under their transforms, as a traversal of the pair needs them.
struct PairFrame {
    TreeMap a_from_b, b_from_a;
    Transform world_from_a{}, world_from_b{};
    float reach_sq = 0; ///< upper bound of the squared world distance of two points of the trees
    bool valid = false; ///< false: a transform is singular, so that there is no frame to compare in
};

/// Computes the frames of a pair of trees.
/// Accuracy    the margins cover all rounding: of the trees, of composing the transforms, and of
///             the world positions that the exact kernels see.
PairFrame make_pair_frame(const Tree& a, const Transform& world_from_a, const Tree& b,
                          const Transform& world_from_b);

} // namespace abut
