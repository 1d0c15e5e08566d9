#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of some points, as a closed surface of triangles.
struct HullSurface {
    int dimension = 0; ///< dimension of the points' affine hull: 0 to 3
    /// Indices of the extreme points: those that the hull of the others does not hold. Sorted;
    /// those of a polygon are in counter-clockwise order about its normal.
    std::vector<std::uint32_t> vertices;
    /// Counter-clockwise as seen from outside. Coplanar triangles are not merged. A polygon is
    /// covered on both sides, with different diagonals; a point and a segment have no triangles.
    std::vector<IndexTriangle> triangles;
};

/// In          finite points, at least one; any of them may coincide.
/// Degenerate  points may span any dimension.
/// Accuracy    exact: no point lies outside any triangle's plane, and no vertex is superfluous.
///             Only then is a vertex that beats its neighbours along a direction the farthest of
///             all, on which everything in this folder rests.
/// Cost        O(n log n) for points in general position.
/// Source      Quickhull [Barber, Dobkin, Huhdanpaa 1996]. Differs: facets are not merged; exact
///             predicates decide which faces see a point, floating-point distances only which point
///             comes next.
HullSurface exact_hull(std::span<const Vec3> points);

} // namespace abut
