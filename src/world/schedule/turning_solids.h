#pragma once

#include "convex/support/support_shape.h"

namespace abut {

/// A solid at one time, and its motion from then on: it turns about a centre at a constant angular
/// velocity, and the centre moves at a constant velocity.
struct TurningSolid {
    const SupportShape& solid; ///< its place at that time
    Vec3 centre, velocity, angular_velocity;
    double swing = 0; ///< no point of the solid's core is ever farther from the centre
};

/// A lower bound of the room between two solids along a unit vector from a to b after some time T.
/// Negative: the bound proves nothing. If the room is g now and the bound h, the room at each earlier time
/// t is at least (1 - t / T) g + (t / T) h.
///
/// Source      a point at r from the centre of a body that turns by w t is n . (r + t w x r) high, give
///             or take t^2 |w| |n x w| |r| / 2. Without the last term, points move along lines. The
///             height of the lowest of them is then a concave function of time, and lies over its chord.
double least_room_after(double time, const TurningSolid& a, const TurningSolid& b, const Vec3& n);

/// A time up to which more than `margin` of room is left along a unit vector, at most `horizon`. 0 if
/// there is no more now.
///
/// Cost        some ten pairs of farthest points.
double time_with_room(const TurningSolid& a, const TurningSolid& b, const Vec3& n, double margin,
                      double horizon);

/// The same, as a sees it: along a vector that turns with a. It proves more where a is large and b is near
/// the place about which a turns.
///
/// Source      in the frame of a, a point of b at x moves at u = v - w x (x - c) with the velocity v less
///             that of a's centre c, and its acceleration along n is at most |w_b|^2 |r| +
///             |n x w| (2 |v| + |w| |x - c|), the latter two by Coriolis' and the centrifugal term.
double time_with_room_beside(const TurningSolid& a, const TurningSolid& b, const Vec3& n,
                             double margin, double horizon);

/// The longest of the times that the world, a and b prove.
double longest_with_room(const TurningSolid& a, const TurningSolid& b, const Vec3& n, double margin,
                         double horizon);

} // namespace abut
