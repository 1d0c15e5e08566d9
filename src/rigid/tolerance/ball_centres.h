#pragma once

#include "rigid/tolerance/face_polygon.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace abut {

/// The centres of all balls of one radius that touch a surface from inside are enclosed by polygons
/// that are farther from what the ball touches than the radius by less than this share of it.
inline constexpr double kCentreError = 0x1p-8;

/// Calls take(polygon) for polygons that stand for the centres of balls that touch some faces from
/// inside: faces moved inward; strips around edges at which the solid's angle exceeds 180 degrees;
/// and pieces of spheres around vertices of at least three such edges. It ends when `take` returns
/// false.
///
/// A ball of radius R that touches a face or an edge or vertex at q has its centre at q + R u. If it
/// lies in a body, so does the ball of every smaller radius s around q + s u. For R at least
/// (1 + kCentreError) radius, some q + s u with s >= radius lies on a polygon, or a ball of radius
/// (1 - kCentreError) radius around a point of a polygon lies in that ball.
///
/// In          faces: with outward normals, all around each edge and vertex that matters; `radius` is
///             positive. is_settled(middle, radius): whether no polygon in a ball is of interest;
///             pieces of spheres there are left out.
/// Cost        O(n log n); a strip for each 7 degrees of an edge. A sphere is divided where it is not
///             settled, into pieces of 4 to 7 degrees.
void for_each_centre_polygon(const std::vector<Triangle>& faces, double radius,
                             const std::function<bool(const FacePolygon&)>& take,
                             const std::function<bool(const Vec3&, double)>& is_settled);

} // namespace abut
