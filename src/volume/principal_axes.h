#pragma once

#include "math/vector.h"

#include <array>
#include <span>

namespace abut {

/// Three unit vectors at right angles, to rounding.
using Axes = std::array<Vec3, 3>;

/// Eigenvectors of the covariance of some points, the widest first.
///
/// In          at least one point.
/// Degenerate  points on a line or at one place: the rest is filled up with any directions.
Axes principal_axes(std::span<const Vec3> points);

/// The same of a surface, every part weighted by its area.
///
/// Degenerate  without area: those of its vertices.
/// Source      [Gottschalk, Lin, Manocha 1996], the integral over a triangle in closed form.
Axes principal_axes(std::span<const Triangle> surface);

/// The same of the surface of the triangles' convex hull, which how finely a part is meshed does
/// not sway; of the triangles themselves if they are few or lie in a plane.
///
/// Cost        under a microsecond for up to 8 triangles; else some 4 us a vertex of the hull, 128
///             of them at most, and a scan.
/// Source      [Gottschalk, Lin, Manocha 1996]. Differs: up to 8 triangles are taken as they are;
///             of more than 128, the hull is that of the extreme vertices along 64 directions.
Axes hull_axes(std::span<const Triangle> triangles);

} // namespace abut
