#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <span>

namespace abut {

struct InnerBall {
    Vec3 middle;       ///< in the hull, to rounding
    double radius = 0; ///< proven: the hull holds all points that are nearer to the middle
};

/// A ball inside a hull, not much smaller than the largest.
///
/// In          an exact hull of points that are all vertices: counter-clockwise triangles.
/// Degenerate  radius 0 and the mean of the vertices, if the hull has no volume, or if it or its
///             triangles are so thin that rounding hides their planes.
/// Cost        some dozen passes over all planes.
/// Source      subgradient steps towards the Chebyshev centre: away from the nearest plane, by
///             decreasing lengths.
InnerBall inner_ball(std::span<const Vec3> vertices, std::span<const IndexTriangle> triangles);

} // namespace abut
