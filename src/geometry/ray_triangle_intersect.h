#pragma once

#include <abut/shapes.h>

#include "math/vector.h"

#include <array>
#include <optional>

namespace abut {

/// The point where a ray meets a triangle.
struct RayTriangleHit {
    double t = 0; ///< the least t of the ray's range at which it is in the triangle
    int side = 0; ///< +1: the ray comes from the side where the vertices run counter-clockwise;
                  ///< -1: from the other side; 0: the ray lies in the triangle's plane, or the
                  ///< triangle has no area
};

/// Where a ray meets a triangle, if it does.
///
/// In          a direction that is not zero; all but the range finite.
/// Degenerate  zero-area triangles act as segments or points. A ray in the triangle's plane meets
///             the triangle where it enters it.
/// Accuracy    exact as to whether they meet. t is precise to 2^-40 relative, and within the ray's
///             range.
/// Cost        three orientation signs, and one for each end of the range.
std::optional<RayTriangleHit> ray_triangle_intersect(const Ray& ray, const Triangle& t);

/// Barycentric coordinates of the point where a ray meets a triangle.
///
/// Accuracy    exactly 0 for the vertex opposite to an edge that the ray meets; otherwise to the
///             rounding of origin + t direction.
std::array<double, 3> hit_weights(const Ray& ray, const Triangle& t, const RayTriangleHit& hit);

/// Sign of t_a - t_b for two triangles that a ray meets: negative if it meets a first. Exact.
int compare_hits(const Ray& ray, const Triangle& a, const RayTriangleHit& hit_a, const Triangle& b,
                 const RayTriangleHit& hit_b);

} // namespace abut
