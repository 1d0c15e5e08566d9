#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/search/gjk.h"

#include <array>
#include <cstdint>
#include <optional>

namespace abut {

/// The boundary point of the difference of two polytopes that is nearest to the origin, and what
/// proves it.
struct NearestBoundary {
    Vec3 normal;         ///< unit vector; the difference lies below its plane
    double depth = 0;    ///< the plane's distance: no corner lies farther along the normal
    double at_least = 0; ///< no plane around the difference is nearer
    std::array<VertexPair, 3> corners{}; ///< of the face that the point lies on
    std::array<double, 3> weights{};     ///< of the point
    std::uint32_t steps = 0;             ///< corners that were added
    /// Without a doubt, as placed by abut/types.h: the origin lies inside, and the depth is not below
    /// `at_least`; and it is not above `depth` by more than a few roundings.
    bool is_inside_proven = false, is_depth_proven = false;
};

/// Grows a polytope inside the difference b - a of two polytopes where its boundary is nearest to the
/// origin, until that is the boundary of the difference.
///
/// Its nearest face is a lower bound of the depth, since it lies inside; the farthest corner of the
/// difference along that face's normal is an upper bound, since its plane has all on one side. When
/// both are equal, to rounding, that is the depth.
///
/// In          `pair` and `rounding` as for `walk`; `start`: a simplex that holds the origin, to
///             rounding.
/// Out         `grown`, if not null: what it has grown to; empty if that is a large one, not
///             closed, or the difference is flat.
/// Source      [van den Bergen 2001]. Differs: it ends by both bounds, and the faces lie in one
///             list; no heap: the upper bound leaves few to look at.
NearestBoundary expand_simplex(const PolytopePair& pair, double rounding,
                               const DifferenceSimplex& start, DifferencePolytope* grown);

/// Goes on with a polytope as of other poses, or other bodies. None if its faces do not go around the
/// origin now, or have come not to.
///
/// It need not be convex any more. If the origin lies below each of its faces, it still has all of
/// the difference's points that are nearer than the nearest plane of a face: seen from the origin,
/// faces that are closed around it cover all directions once. So the lower bound holds.
///
/// In/out      `last`: what it grows to, as above; as it was if the answer is none.
std::optional<NearestBoundary> expand_again(const PolytopePair& pair, double rounding,
                                            DifferencePolytope& last);

} // namespace abut
