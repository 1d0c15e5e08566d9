#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"

#include <array>
#include <cstdint>

namespace abut {

/// Up to four corners of the difference of two polytopes b - a, and the point of their hull that is
/// nearest to the origin.
struct DifferenceSimplex {
    std::array<VertexPair, 4> corners{};
    std::array<double, 4> weights{}; ///< of that point; positive, their sum is 1
    std::uint32_t count = 0;
};

/// In          fewer than four corners.
void add_if_new(const VertexPair& corner, DifferenceSimplex& simplex);

struct GjkState {
    DifferenceSimplex simplex;
    bool meeting = false; ///< the origin lies in the simplex: so the polytopes share a point
    bool proven = false;  ///< meeting: without a doubt, as placed by abut/types.h
    Vec3 point_a;         ///< in the pair's frame: the weighted sum of the vertices of a
    Vec3 gap;             ///< to that of b
    double distance_sq = 0;
    double excess = 0;       ///< no point is nearer than the distance less this over the distance
    std::uint32_t steps = 0; ///< simplices that were measured
};

/// Closest points of two polytopes, or a common point, from any corners of their difference: looks
/// for the corner farthest against the gap, which is the farthest vertex of each, until there is
/// none nearer to the origin.
///
/// In          `start`: at least one corner; weights are not looked at. `rounding` as for `walk`.
/// Accuracy    as for `walk`. Meeting: the common point lies in both to a few times `rounding`.
/// Source      [Gilbert, Johnson, Keerthi 1988], support by hill climbing [Cameron 1997].
GjkState gjk(const PolytopePair& pair, const DifferenceSimplex& start, double rounding);

} // namespace abut
