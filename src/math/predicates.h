#pragma once

#include <abut/types.h>

#include <cstdint>

/// Exact signs of determinants of coordinates: a filter with a certified error bound decides nearly
/// all, integer arithmetic the rest. Coordinates must be finite.
namespace abut {

/// Sign of ((b - a) x (c - a)) . (d - a): +1 if d lies on the side of the plane abc from which a,
/// b, c run counter-clockwise, -1 on the other, 0 on the plane.
///
/// Accuracy    exact, over- and underflow included.
/// Source      filter as [Shewchuk 1997, orient3d stage A], differs: an underflow term in the
///             bound.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of direction . ((p - origin) x (q - origin)): +1 if the edge from p to q runs
/// counter-clockwise around the line as seen against its direction, 0 if the line and the edge lie
/// in one plane.
///
/// In          the direction is no difference of points: it is taken as given.
/// Accuracy    exact, as orient3d.
int turn_around_line(const Vec3& origin, const Vec3& direction, const Vec3& p, const Vec3& q);

/// Sign of the doubled area of a, b, c projected along `axis` (0, 1, 2: on yz, zx, xy). Exact.
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// Whether the three points lie on one line (or coincide). Exact.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// How many signs this thread has decided by integer arithmetic so far.
std::uint64_t exact_signs();

} // namespace abut
