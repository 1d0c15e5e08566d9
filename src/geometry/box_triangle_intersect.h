#pragma once

#include "math/vector.h"

namespace abut {

/// Whether a closed axis-aligned box and a triangle share a point.
///
/// In          a box that is not empty; all finite.
/// Degenerate  zero-area triangles act as segments or points, flat boxes as rectangles, segments or
///             points.
/// Accuracy    exact.
/// Source      13 separating axes [Akenine-Moller 2001]. Differs: an axis is tested only where its
///             plane can support both shapes, so that signs of determinants suffice.
bool box_triangle_intersect(const Box3& box, const Triangle& t);

} // namespace abut
