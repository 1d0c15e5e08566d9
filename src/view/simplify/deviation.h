#pragma once

#include "view/simplify/triangle_search.h"

#include <span>

namespace abut {

/// An upper bound on the distance from any point of some triangles to a surface.
///
/// In          least: a bound that is good enough; nothing smaller is looked for. most: once the
///             bound exceeds this, it is returned as it is, and is no bound.
/// Accuracy    proven, to rounding. At most 1.1 times the largest distance, or `least`, unless the
///             surface needs more than 400 pieces for one triangle.
/// Source      A triangle is divided into convex pieces. The distance to one face is a convex
///             function, so the corners of a piece bound it. Pieces are cut along the faces' edges.
double deviation_bound(std::span<const Triangle> from, const TriangleSearch& to, double least,
                       double most);

} // namespace abut
