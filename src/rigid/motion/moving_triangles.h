#pragma once

#include "geometry/triangle_triangle_distance.h"
#include "rigid/motion/moving_pair.h"

namespace abut {

/// How long two triangles of a and b do not meet, from `time` on, when they are at the given places
/// in the world and `closest` are their closest points. Infinite: they never meet.
///
/// Degenerate  needles and points are handled: directions that rounding spoils are replaced by
///             those of edges and faces.
double free_time(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                 const ClosestPoints& closest, double horizon);

} // namespace abut
