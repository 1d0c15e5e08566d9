#pragma once

#include "rigid/contacts.h"
#include "rigid/placed_solid.h"

#include <span>

namespace abut {

/// How deep two models that interpenetrate go into each other.
struct LocalPenetration {
    double depth = 0;   ///< a depth that is reached
    double at_most = 0; ///< no deeper than this, proven
    Vec3 point_a, point_b;
    Vec3 direction; ///< unit vector along which b moves to get out at point_a; zero if the depth is
};

struct PenetrationOptions {
    /// The comparison that matters: the search goes on until the depth is known to be above it or
    /// not.
    double threshold = 0;
    /// Relative width that [depth, at_most] should have.
    double relative_accuracy = 0.01;
    /// Evaluated points, at most: for the accuracy, and for the comparison.
    int accuracy_budget = 200, threshold_budget = 20000;
};

/// Local penetration depth.
///
/// With a solid: the largest distance from a point of the other's surface inside the solid to the
/// solid's surface (of two solids, the larger of both ways). Between open surfaces: the largest,
/// over the crossing triangle pairs, of the shortest translation that separates the two triangles.
///
/// Accuracy    with a solid, `depth` is reached at point_a and point_b to rounding, and
///             [depth, at_most] encloses the true value; else it is the definition's value at a
///             common point.
/// Source      branch and bound; the bound over a piece is the largest distance of its corners to
///             one triangle of the solid (distance to a convex set is convex).
LocalPenetration penetration_depth(const PlacedSolid& a, const PlacedSolid& b,
                                   std::span<const Contact> contacts,
                                   const PenetrationOptions& options);

} // namespace abut
