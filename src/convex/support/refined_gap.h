#pragma once

#include "convex/support/support_pair.h"

#include <optional>

namespace abut {

/// A local minimum of the support function of the difference on the unit sphere. It is minus the
/// distance of two cores that are apart, or the depth of two that meet.
struct RefinedGap {
    Vec3 outward;           ///< unit vector: out of the difference, so from b to a
    double value = 0;       ///< the coordinate of the difference's farthest point along it
    DifferencePoint points; ///< b - a is `value` times the unit vector, to a few roundings
};

/// Improves a direction to the last digits.
///
/// In          outward: the direction, to about 1e-4. nearest: points of the difference, and the
///             weights of the point of their hull that is nearest to the origin, or nearly so. They
///             tell on which features of the cores the points are: face, edge, side, rim, vertex.
///             at_most: a larger value is another minimum than the one that is meant. across: if not
///             zero, the direction stays across this vector.
/// Out         none if the features do not agree with the direction, or Newton's method fails.
/// Accuracy    the value and b - a: a few roundings. The direction: the same over the curvature.
/// Source      Newton's method on the conditions of a minimum with Lagrange's multipliers: the
///             direction is across each edge, axis or face that holds a point in its inside.
std::optional<RefinedGap> refined(const SupportPair& pair, const Vec3& outward,
                                  const SupportSimplex& nearest, double at_most,
                                  const Vec3& across = {});

} // namespace abut
