#pragma once

#include "convex/support/support_pair.h"

#include <cstdint>

namespace abut {

/// The depth of two cores that share a point, in the pair's frame, with bounds.
struct SupportDepth {
    Vec3 normal;           ///< unit vector: moving b by `depth` along it separates the cores
    double depth = 0;      ///< an upper bound: that motion is enough. Negative: they are apart
    double at_least = 0;   ///< no shorter motion separates them, but for rounding
    Vec3 point_a, point_b; ///< the points that the motion brings together
};

/// The work that a search for a depth may take.
enum class DepthEffort : std::uint8_t {
    bound, ///< of any cores a lower bound, of most also the depth: up to 256 points
    full,  ///< up to 2,048 points, which few cores need
};

/// Allowed difference of the two bounds of a depth, relative to the size of both shapes together.
inline constexpr double kDepthTolerance = 1e-12;

/// Finds the shortest motion that separates two cores.
///
/// In          `start`: a simplex of the difference that holds the origin, or is near it.
/// Accuracy    the bounds agree to kDepthTolerance, unless nearly as short motions along very many
///             directions need more points than the effort allows. The depth is still that of a
///             local minimum, to a few roundings, and the normal as `refined` says.
/// Degenerate  a flat difference has depth 0 across it.
/// Source      the expanding polytope [van den Bergen 2001]: a polytope inside the difference grows
///             at its face nearest to the origin. Differs: it ends by the upper bound that every
///             farthest point gives; the planes of thin faces are computed with 106 bits, so that
///             the nearest plane is a lower bound.
SupportDepth support_depth(const SupportPair& pair, const SupportSimplex& start,
                           DepthEffort effort);

} // namespace abut
