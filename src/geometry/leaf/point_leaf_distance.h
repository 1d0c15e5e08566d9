#pragma once

#include "geometry/leaf/triangle_leaf.h"

#include <array>

namespace abut {

/// Lower bounds on the squared distances from a point to a leaf's triangles, in the leaf's frame.
///
/// In          margin: bound on the error of the difference of a coordinate of the point and one of
///             a triangle, beyond the rounding of the difference itself.
/// Accuracy    certain. Below the distance by about three margins if single precision finds the
///             triangle's nearest point; for a needle the bound may be far too low.
/// Cost        some 110 operations for all four.
void point_leaf_distance_sq(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                            float margin, float (&lower_sq)[TriangleLeaf::kLanes]);

/// point_leaf_distance_sq with one lane: the reference for every SIMD target.
void point_leaf_distance_sq_reference(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                                      float margin, float (&lower_sq)[TriangleLeaf::kLanes]);

} // namespace abut
