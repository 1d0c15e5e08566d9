#pragma once

#include "convex/proof/integer_difference.h"
#include "convex/proof/placed_points.h"
#include "convex/search/epa.h"
#include "convex/search/gjk.h"

namespace abut {

/// EPA in integers: the boundary point nearest to the origin of the difference of two convex hulls.
///
/// In          `start`: corners whose hull certainly holds the origin (exact_closest_points.h).
///             Corners are numbered by points.
/// Out         `depth` and `at_least` differ by rounding alone: 2^-48 of the depth.
/// Accuracy    every decision is exact; the numbers are rounded.
/// Source      [van den Bergen 2001] in integers. Corners in the plane of a face count as beyond
///             it, so that no face has zero area.
NearestBoundary exact_depth(const PlacedPoints& points, const IntegerGrid& grid,
                            const DifferenceSimplex& start);

} // namespace abut
