#pragma once

#include "convex/feature_walk.h"
#include "convex/placed_polytope.h"
#include "convex/simplex_search.h"

#include <cstdint>

namespace abut {

/// The closest points of two polytopes, or a common one.
struct ClosestState {
    HullFeature a, b;          ///< what the points lie on
    DifferenceSimplex simplex; ///< if meeting, and found so: whose corners prove it
    Vec3 point_a, gap;         ///< in the pair's frame; gap: to the point of b
    double distance_sq = 0;
    bool meeting = false; ///< at most `rounding` apart
    std::uint32_t feature_pairs = 0, simplices = 0;
};

/// Walks from a pair of features, and leaves the cases in which walking ends early to the search by
/// simplices.
///
/// In          as `walk`.
ClosestState closest_points(const PolytopePair& pair, const HullFeature& a, const HullFeature& b,
                            double rounding);

/// The same from a simplex, as of polytopes that meet and may have moved since.
ClosestState closest_points(const PolytopePair& pair, const DifferenceSimplex& start,
                            double rounding);

} // namespace abut
