#pragma once

#include <abut/types.h>

/// Products, inverses and images of poses, for programs that place one frame in another.
namespace abut {

/// The pose that applies b, then a: world_from_b = world_from_a * a_from_b.
///
/// Degenerate  the quaternions need not be of unit length; the product's is.
/// Accuracy    to rounding; the length stays 1 however many products follow each other.
/// Errors      of all functions here: Error{bad_argument} if a quaternion has zero length or a value is
///             not finite.
Pose operator*(const Pose& a, const Pose& b);

/// The pose that undoes this one: inverse(a) * a is the identity, to rounding.
Pose inverse(const Pose& pose);

/// Where the pose takes a point: rotated, then moved. The same number as by Transform(pose).
Vec3 apply(const Pose& pose, const Vec3& point);

/// Where the pose takes a direction or a velocity: rotated only.
Vec3 rotate(const Pose& pose, const Vec3& direction);

} // namespace abut
