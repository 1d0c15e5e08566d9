#pragma once

#include "math/vector.h"

#include <cstdint>

namespace abut {

/// How two triangles meet.
enum class TriangleContact : std::uint8_t {
    none,  ///< no common point
    touch, ///< common points, but a plane separates the triangles weakly: they cross nowhere
    cross, ///< the relative interiors cross transversally: no small translation separates them
};

/// Whether two triangles share a point, and whether they cross there.
///
/// In          any six finite points in one frame.
/// Degenerate  zero-area triangles act as segments or points. These, and coplanar triangles, touch
///             at most.
/// Accuracy    exact.
/// Cost        6 to 8 orientation signs; up to some 40 for coplanar or degenerate triangles.
/// Source      [Guigue, Devillers 2003]. Differs: the line test uses one sign per triangle instead
///             of permuted arguments, and the result distinguishes touching from crossing.
TriangleContact triangle_triangle_intersect(const Triangle& a, const Triangle& b);

/// Whether a closed segment (or point, if p = q) shares a point with a triangle that has an area.
/// Exact.
bool segment_triangle_intersect(const Vec3& p, const Vec3& q, const Triangle& t);

/// Whether two closed segments (or points) share a point. Exact.
bool segment_segment_intersect(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

/// An axis along which the projection of a triangle keeps its area; -1 if the triangle has no area.
/// Exact.
int projection_axis(const Triangle& t);

} // namespace abut
