#pragma once

#include "geometry/triangle_leaf.h"

#include <array>

namespace abut {

/// Lower bounds of the squared distances from a point to a leaf's triangles, in the leaf's frame.
///
/// In          margin: what the difference of a coordinate of the point and one of a triangle may
///             be off by, beyond the rounding of the difference itself.
/// Accuracy    certain. Short of the distance by about three margins, for a triangle whose nearest
///             point single precision finds; a needle's may be far too low.
/// Cost        some 110 operations for all four.
void point_leaf_distance_sq(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                            float margin, float (&lower_sq)[TriangleLeaf::kLanes]);

/// The same with one lane: the reference for every SIMD target.
void point_leaf_distance_sq_reference(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                                      float margin, float (&lower_sq)[TriangleLeaf::kLanes]);

} // namespace abut
