#pragma once

#include <abut/types.h>

#include <limits>

/// Times before which two moving bodies cannot meet: the inequalities on which the schedule rests.
/// docs/schedule.md derives them. Times count from now. A result is 0 if nothing is proven, and
/// infinite if the bodies never meet.
namespace abut {

/// Share of lengths, speeds and times that is given away for rounding, always to the safe side.
inline constexpr double kScheduleRounding = 0x1p-40;
inline constexpr double kNoCollision = std::numeric_limits<double>::infinity();

/// How a body may rotate about its origin: with a known angular velocity, and another one whose
/// length is at most speed + t acceleration.
struct TurnBounds {
    Vec3 velocity;
    double speed = 0, acceleration = 0;
    double reach = 0; ///< no point of the body is farther from its origin
};

/// How the origin of body a may move relative to that of body b, and how both may rotate.
struct RelativeMotion {
    Vec3 velocity, acceleration;   ///< known
    double speed = 0;              ///< bound of a further velocity
    double acceleration_bound = 0; ///< bound of a further acceleration
    TurnBounds a, b;
    bool prescribed = false; ///< there is nothing further, and the accelerations are equal
};

/// A time before which a gap between two slabs stays open. No point of a lies beyond the first slab
/// along n now, and no point of b before the second.
///
/// In          n: unit vector from a to b. gap: the distance of the slabs.
double time_along(const RelativeMotion& motion, const Vec3& n, double gap);

/// A time before which two bodies of any shape, `distance` apart now, do not meet.
double time_from_distance(const RelativeMotion& motion, double distance);

/// The distance that two bodies may close in a time, to rounding.
double distance_closed(const RelativeMotion& motion, double time);

/// A time before which the balls around the origins that enclose the bodies do not meet. Exact if
/// there are no further velocities and accelerations.
///
/// In          between: from the origin of b to the origin of a. size: of the coordinates.
double time_of_balls(const RelativeMotion& motion, const Vec3& between, double size);

} // namespace abut
