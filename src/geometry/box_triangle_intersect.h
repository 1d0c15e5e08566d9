#pragma once

#include "math/vector.h"

namespace abut {

/// Whether a closed axis-aligned box and a triangle share a point.
///
/// In          a box that is not empty; all finite.
/// Degenerate  zero-area triangles act as segments or points, flat boxes as what they are.
/// Accuracy    exact.
/// Source      13 separating axes [Akenine-Moller 2001]. Differs: each is asked only where it could
///             be a supporting plane of both, which needs nothing but signs of determinants.
bool box_triangle_intersect(const Box3& box, const Triangle& t);

} // namespace abut
