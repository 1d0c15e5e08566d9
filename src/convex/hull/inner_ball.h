#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <span>

namespace abut {

struct InnerBall {
    Vec3 middle;
    double radius = 0; ///< the hull holds all that is nearer to the middle: proven
};

/// A ball inside of a hull, not much smaller than the largest.
///
/// In          an exact hull of points that are all vertices: counter-clockwise triangles.
/// Degenerate  radius 0 where the hull has no volume, or it or its triangles are so thin that no ball is
///             found or rounding hides where their planes are; the middle of the box then.
/// Cost        some dozen looks at all planes.
/// Source      subgradient steps towards the Chebyshev centre: away from the nearest plane, by ever
///             less.
InnerBall inner_ball(std::span<const Vec3> vertices, std::span<const IndexTriangle> triangles);

} // namespace abut
