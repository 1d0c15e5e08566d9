#pragma once

#include "math/vector.h"

#include <array>
#include <span>

namespace abut {

/// Three unit vectors, orthogonal up to rounding.
using Axes = std::array<Vec3, 3>;

/// Eigenvectors of the covariance of some points, in order of decreasing variance.
///
/// In          at least one point.
/// Degenerate  for collinear or coincident points, the remaining axes are arbitrary.
Axes principal_axes(std::span<const Vec3> points);

/// As above, for a surface: every part is weighted by its area.
///
/// Degenerate  a surface without area: the axes of its vertices.
/// Source      [Gottschalk, Lin, Manocha 1996], the integral over a triangle in closed form.
Axes principal_axes(std::span<const Triangle> surface);

/// The axes of the surface of the triangles' convex hull. They do not depend on how finely a part
/// of the surface is meshed. For few or coplanar triangles, the axes of the triangles themselves.
///
/// Cost        under a microsecond for up to 8 triangles; else a scan and about 4 us for each
///             vertex of the hull. A hull has at most 128 vertices, or 384 if up to 128 triangles
///             share none.
/// Source      [Gottschalk, Lin, Manocha 1996]. Differs: up to 8 triangles are used without a hull;
///             for more than 128 triangles, the hull is that of the extreme vertices along 64
///             directions.
Axes hull_axes(std::span<const Triangle> triangles);

} // namespace abut
