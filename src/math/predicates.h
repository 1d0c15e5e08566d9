#pragma once

#include <abut/types.h>

#include <cstdint>

/// Exact signs of determinants of coordinates. A floating-point filter with a proven error bound
/// decides nearly all of them, integer arithmetic the rest. Coordinates must be finite.
namespace abut {

/// Sign of ((b - a) x (c - a)) . (d - a): +1 if d lies on the side of the plane abc from which a,
/// b, c run counter-clockwise, -1 on the other side, 0 in the plane.
///
/// Accuracy    exact, also when numbers over- or underflow.
/// Source      filter as [Shewchuk 1997, orient3d stage A]. Differs: the bound has an underflow
///             term.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of direction . ((p - origin) x (q - origin)): +1 if the edge from p to q runs
/// counter-clockwise around the line, seen against its direction; 0 if the line and the edge are
/// coplanar.
///
/// In          direction: taken exactly as given, not as a difference of points.
/// Accuracy    exact, as orient3d.
int turn_around_line(const Vec3& origin, const Vec3& direction, const Vec3& p, const Vec3& q);

/// Sign of twice the area of triangle a, b, c projected along `axis` (0, 1, 2: onto yz, zx, xy).
/// Exact.
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// Whether the three points lie on one line (or coincide). Exact.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Number of signs that this thread has decided by integer arithmetic so far.
std::uint64_t exact_signs();

} // namespace abut
