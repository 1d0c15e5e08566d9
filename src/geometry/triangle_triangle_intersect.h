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
/// Degenerate  zero-area triangles are the segments or points that they are; these and coplanar
///             triangles touch at most.
/// Accuracy    exact.
/// Cost        6 to 8 orientation signs; up to some 40 where triangles are coplanar or degenerate.
/// Source      [Guigue, Devillers 2003]. Differs: the line test is written with one sign per
///             triangle in place of permuted arguments, and returns touching and crossing apart.
TriangleContact triangle_triangle_intersect(const Triangle& a, const Triangle& b);

/// Whether a closed segment (or point, if p = q) shares a point with a triangle that has an area.
/// Exact.
bool segment_triangle_intersect(const Vec3& p, const Vec3& q, const Triangle& t);

/// Whether two closed segments (or points) share a point. Exact.
bool segment_segment_intersect(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

/// An axis along which the projection of a triangle keeps its area; -1 if it has none. Exact.
int projection_axis(const Triangle& t);

} // namespace abut
