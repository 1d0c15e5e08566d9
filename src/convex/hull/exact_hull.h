#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of some points, as a closed surface of triangles.
struct HullSurface {
    int dimension = 0; ///< of what the points span: 0 to 3
    /// The extreme points, as indices: those that the hull of the others does not hold. Sorted; of
    /// a polygon, in counter-clockwise order about its normal.
    std::vector<std::uint32_t> vertices;
    /// Counter-clockwise as seen from outside. Coplanar triangles are separate. A polygon is
    /// covered from both sides, no edge twice from the same; a point and a segment have none.
    std::vector<IndexTriangle> triangles;
};

/// In          finite points, at least one; any of them may coincide.
/// Degenerate  any dimension is as good as another.
/// Accuracy    exact: no point lies outside of any triangle's plane, and no vertex is superfluous.
///             Only then is a vertex that beats its neighbours along a direction the best of all,
///             on which everything in this folder rests.
/// Cost        O(n log n) for points in general position.
/// Source      Quickhull [Barber, Dobkin, Huhdanpaa 1996]. Differs: no facets are merged; exact
///             predicates decide what is visible, distances in floating point only which point
///             comes next.
HullSurface exact_hull(std::span<const Vec3> points);

} // namespace abut
