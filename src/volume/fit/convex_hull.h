#pragma once

#include "math/vector.h"

#include <span>
#include <vector>

namespace abut {

/// The triangles of the convex hull of some points, in either orientation.
///
/// Degenerate  empty if the points span no volume beyond rounding.
/// Accuracy    for statistics only: facets that are flat to rounding may have been merged, and a
///             point may lie outside by as much. No bounding volume relies on it to enclose.
/// Cost        O(n log n).
/// Source      Qhull [Barber, Dobkin, Huhdanpaa 1996].
std::vector<Triangle> convex_hull(std::span<const Vec3> points);

} // namespace abut
