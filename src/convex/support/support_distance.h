#pragma once

#include "convex/support/support_pair.h"

#include <limits>

namespace abut {

/// The distance of two cores, in the pair's frame, with bounds.
struct SupportDistance {
    bool meet = false;   ///< the cores share a point, to rounding
    double distance = 0; ///< of two points of the cores, so an upper bound
    double at_least = 0; ///< no two points are nearer, but for rounding
    Vec3 direction;      ///< from a to b, not of unit length: the vector between the two points
    SupportSimplex simplex;
};

/// When a search for a distance may end early.
struct SupportSearch {
    Vec3 first; ///< a guess of the direction from a to b; zero: none
    double apart = std::numeric_limits<double>::infinity(); ///< once at_least exceeds this
    double near = -1;                                       ///< once distance is at most this
};

/// Finds the closest points of two cores, or a common point.
///
/// Accuracy    `distance - at_least` is a few roundings unless the search ended early. The points
///             are accurate to the square root of that.
/// Source      [Gilbert, Johnson, Keerthi 1988]. The difference of the bounds is the duality gap of
///             the nearest point of the simplex, as in [Gilbert 1966].
SupportDistance support_distance(const SupportPair& pair, const SupportSearch& search);

} // namespace abut
