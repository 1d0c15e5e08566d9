#pragma once

#include "convex/hull/exact_hull.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Vertices that a walkable hull does without.
struct LeftOutVertices {
    std::vector<std::uint32_t> vertices; ///< of the exact hull, by numbers of points
    double outside = 0; ///< no such vertex lies farther from the walkable hull: a length
};

/// The convex hull of some points, less those vertices that the hull of the others holds to
/// rounding: 2^-46 of the largest coordinate.
///
/// Around such a vertex, the surface is flat or bends along an edge by so little that rounding hides
/// on which side the body is: a walk would take it for the farthest vertex along the direction
/// inwards too. Without them, a vertex that beats its neighbours is the best of all, in floating
/// point as well.
///
/// In, errors, cost: as exact_hull, some times.
/// Out         `left_out`, if not null.
HullSurface walkable_hull(std::span<const Vec3> points, LeftOutVertices* left_out = nullptr);

} // namespace abut
