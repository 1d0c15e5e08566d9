#pragma once

#include <abut/shapes.h>

#include "math/vector.h"

#include <array>
#include <optional>

namespace abut {

/// Where a ray meets a triangle.
struct RayTriangleHit {
    double t = 0; ///< of its range that lies in the triangle, the least
    int side = 0; ///< +1: the ray comes from the side where the vertices run counter-clockwise;
                  ///< -1: from the other side; 0: the ray lies in the triangle's plane, or the
                  ///< triangle has no area
};

/// Whether a ray meets a triangle.
///
/// In          a direction that is not zero; all but the range finite.
/// Degenerate  zero-area triangles are the segments or points that they are; a ray in the plane
///             meets the triangle where it enters.
/// Accuracy    whether: exact. t: to 2^-40 relative, and within the ray's range.
/// Cost        three signs, and one for each end of the range.
std::optional<RayTriangleHit> ray_triangle_intersect(const Ray& ray, const Triangle& t);

/// Barycentric coordinates of the point where a ray meets a triangle.
///
/// Accuracy    exactly 0 for the vertex across from an edge that the ray meets; else to the
///             rounding of origin + t direction.
std::array<double, 3> hit_weights(const Ray& ray, const Triangle& t, const RayTriangleHit& hit);

/// Sign of t_a - t_b for two triangles that a ray meets: negative if it meets a first. Exact.
int compare_hits(const Ray& ray, const Triangle& a, const RayTriangleHit& hit_a, const Triangle& b,
                 const RayTriangleHit& hit_b);

} // namespace abut
