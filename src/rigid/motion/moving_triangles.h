#pragma once

#include "geometry/triangle_triangle_distance.h"
#include "rigid/motion/moving_pair.h"

namespace abut {

/// From `time` on, when the triangles (of a and b, in the world) are where they are given and these
/// are their closest points: they do not meet for at least this long; infinite: never.
///
/// Degenerate  needles and points are as good as any: directions that rounding spoils are replaced
///             by those of their edges and faces.
double free_time(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                 const ClosestPoints& closest, double horizon);

} // namespace abut
