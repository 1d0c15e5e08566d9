// The Gilbert-Johnson-Keerthi algorithm (GJK): the distance of two convex polytopes.
//
// Two bodies meet if, and only if, the difference b - a of their points holds the origin; otherwise
// their distance is that of the difference from the origin. GJK keeps a simplex of up to four
// corners of the difference, finds the point of it nearest to the origin, and adds the corner of
// the difference that is farthest towards the origin. It ends when no corner is nearer along that
// direction, or when the simplex holds the origin. The farthest corner of the difference is made of
// a farthest vertex of each body, found by hill climbing (hull/climb.h), so the difference is never
// built.

#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"

#include <array>
#include <cstdint>

namespace abut {

/// Up to four corners of the difference b - a of two polytopes, and the weights of the point of
/// their hull that is nearest to the origin.
struct DifferenceSimplex {
    std::array<VertexPair, 4> corners{};
    std::array<double, 4> weights{}; ///< of that point: positive, with sum 1
    std::uint32_t count = 0;
};

/// In          fewer than four corners.
void add_if_new(const VertexPair& corner, DifferenceSimplex& simplex);

struct GjkState {
    DifferenceSimplex simplex;
    bool meeting = false; ///< the simplex holds the origin, so the polytopes share a point
    bool proven = false;  ///< meeting is certain, for positions as abut/types.h computes them
    Vec3 point_a;         ///< in the pair's frame: the weighted sum of the vertices of a
    Vec3 gap;             ///< from `point_a` to the point of b
    double distance_sq = 0;
    double excess = 0;       ///< no two points are nearer than distance - excess / distance
    std::uint32_t steps = 0; ///< simplices measured
};

/// Finds the closest points of two polytopes, or a common point, from any corners of their
/// difference.
///
/// In          `start`: at least one corner; its weights are not read. `rounding` as for `walk`.
/// Accuracy    as for `walk`. Meeting: the common point lies in both to a few times `rounding`.
/// Source      [Gilbert, Johnson, Keerthi 1988], support by hill climbing [Cameron 1997].
GjkState gjk(const PolytopePair& pair, const DifferenceSimplex& start, double rounding);

} // namespace abut
