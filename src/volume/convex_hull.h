#pragma once

#include "math/vector.h"

#include <span>
#include <vector>

namespace abut {

/// The triangles of the convex hull of some points, turned either way.
///
/// Degenerate  empty if the points span no volume beyond rounding.
/// Accuracy    for statistics: facets that are flat to rounding may have been merged, and a point
///             may lie outside by as much. Nothing that must enclose is built on it.
/// Cost        O(n log n).
/// Source      Qhull [Barber, Dobkin, Huhdanpaa 1996].
std::vector<Triangle> convex_hull(std::span<const Vec3> points);

} // namespace abut
