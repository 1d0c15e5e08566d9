#pragma once

#include "math/vector.h"

namespace abut {

/// Whether some point of a triangle is at most `radius` away from a point.
///
/// In          finite, at most 1e18 in magnitude; radius not negative.
/// Degenerate  zero-area triangles act as segments or points. With radius 0, tests whether the
///             point lies on the triangle.
/// Accuracy    exact: two certified bounds decide nearly all cases, exact arithmetic the rest.
bool sphere_triangle_intersect(const Vec3& centre, double radius, const Triangle& t);

} // namespace abut
