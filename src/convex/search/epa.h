// The Expanding Polytope Algorithm (EPA): penetration depth of two convex polytopes.
//
// The depth is the distance from the origin to the boundary of the difference b - a. EPA begins
// with a simplex of corners of the difference that holds the origin (GJK ends with one, gjk.h). It
// takes the face nearest to the origin, looks for the farthest corner of the difference along the
// face's normal, and adds that corner to the polytope. It ends when no corner lies farther than the
// face: then the face is a part of the boundary.

#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/search/gjk.h"

#include <array>
#include <cstdint>
#include <optional>

namespace abut {

/// The boundary point of the difference of two polytopes that is nearest to the origin, with
/// bounds.
struct NearestBoundary {
    Vec3 normal;         ///< unit vector; the difference lies below the plane with this normal
    double depth = 0;    ///< that plane's distance: no corner lies farther along the normal
    double at_least = 0; ///< lower bound: no plane with the difference on one side is nearer
    std::array<VertexPair, 3> corners{}; ///< of the face that holds the point
    std::array<double, 3> weights{};     ///< of the point
    std::uint32_t steps = 0;             ///< corners added
    /// For positions as in abut/types.h. `is_inside_proven`: the origin certainly lies inside, and
    /// the depth is at least `at_least`. `is_depth_proven`: the depth certainly exceeds `depth` by
    /// a few roundings at most.
    bool is_inside_proven = false, is_depth_proven = false;
};

/// Grows a polytope inside the difference b - a of two polytopes, at the face nearest to the
/// origin, until that face lies on the boundary of the difference.
///
/// The nearest face's distance is a lower bound of the depth, since the polytope lies inside the
/// difference. The distance of the plane through the farthest corner along the face's normal is an
/// upper bound, since the whole difference is on one side of it. The search ends when both agree to
/// rounding.
///
/// In          `pair` and `rounding` as for `walk`; `start`: a simplex that holds the origin, to
///             rounding.
/// Out         `grown`, if not null: the final polytope; empty if it has too many faces, is not
///             closed, or the difference is flat.
/// Source      [van den Bergen 2001]. Differs: it ends by both bounds; the faces are in a list, not
///             a heap, since the upper bound leaves few to compare.
NearestBoundary expand_simplex(const PolytopePair& pair, double rounding,
                               const DifferenceSimplex& start, DifferencePolytope* grown);

/// Continues with a polytope that was grown for other poses, or for other bodies. None if its faces
/// do not go around the origin now, or stop doing so while it grows.
///
/// The polytope need not be convex any more. If the origin lies below each of its faces, it still
/// holds all points of the difference that are nearer to the origin than the nearest plane of a
/// face: closed faces that all turn their inner side to the origin cover all directions once. So
/// the lower bound holds.
///
/// In/out      `last`: replaced by the final polytope, as `grown` above; unchanged if there is no
///             answer.
std::optional<NearestBoundary> expand_again(const PolytopePair& pair, double rounding,
                                            DifferencePolytope& last);

} // namespace abut
