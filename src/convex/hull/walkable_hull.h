#pragma once

#include "convex/hull/exact_hull.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

struct LeftOutVertices {
    std::vector<std::uint32_t> vertices; ///< indices of points that are vertices of the exact hull
    double outside = 0; ///< a length: no such vertex lies farther from the walkable hull
};

/// The convex hull of some points, without those vertices that lie within rounding (2^-46 of the
/// largest coordinate) of the hull of the others.
///
/// At such a vertex the surface is flat, or bends along an edge, by so little that rounding hides
/// on which side the body is: a walk would take it for the farthest vertex along the inward
/// direction too. Without them, a vertex that beats its neighbours is the farthest of all in
/// floating point as well.
///
/// In, errors, cost: as exact_hull, for several rounds.
/// Out         `left_out`, if not null.
HullSurface walkable_hull(std::span<const Vec3> points, LeftOutVertices* left_out = nullptr);

} // namespace abut
