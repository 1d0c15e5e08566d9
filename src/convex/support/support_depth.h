#pragma once

#include "convex/support/support_pair.h"

namespace abut {

/// The depth of two cores that share a point, in the pair's frame, with bounds.
struct SupportDepth {
    Vec3 normal;           ///< unit vector: moving b by `depth` along it separates the cores
    double depth = 0;      ///< an upper bound: that motion is enough
    double at_least = 0;   ///< no shorter motion separates them, but for rounding
    Vec3 point_a, point_b; ///< the points that the motion brings together
};

/// Allowed difference of the two bounds of a depth, relative to the size of both shapes together.
inline constexpr double kDepthTolerance = 1e-12;

/// Finds the shortest motion that separates two cores.
///
/// In          `start`: a simplex of the difference that holds the origin, to rounding.
/// Accuracy    the bounds agree to kDepthTolerance, unless rounding ends the search before.
/// Degenerate  a flat difference has depth 0 across it.
/// Source      the expanding polytope [van den Bergen 2001]: a polytope inside the difference grows
///             at its face nearest to the origin. Differs: it ends by the upper bound that every
///             farthest point gives.
SupportDepth support_depth(const SupportPair& pair, const SupportSimplex& start);

} // namespace abut
