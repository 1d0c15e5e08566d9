#pragma once

#include <abut/types.h>

#include "math/vector.h"

#include <array>
#include <cstdint>

namespace abut {

/// A feature of a triangle: vertex i, the edge from vertex i to the next, or the face.
struct TriangleFeature {
    Feature kind = Feature::face;
    std::uint8_t index = 0;
};

/// Two witness points and their squared distance; for triangles also the features that hold them.
struct ClosestPoints {
    double distance_sq = 0;
    Vec3 a, b;
    TriangleFeature on_a{}, on_b{};
};

/// Foot of a point on the plane of a triangle, if it lies within the triangle.
struct TriangleFoot {
    bool within = false;
    Vec3 point, gap;                 ///< gap: from the foot to the point
    std::array<double, 3> weights{}; ///< barycentric
};

/// The foot of a point within a triangle.
///
/// Accuracy    the foot is off by a few roundings of the coordinates' differences, however narrow a
///             needle is. A triangle that is flat to rounding has no foot.
TriangleFoot foot_within(const Vec3& p, const Triangle& t);

/// The triangle's point nearest to a given point, and the feature that holds it.
struct NearestOnTriangle {
    double distance_sq = 0;
    Vec3 point;
    std::array<double, 3> weights{}; ///< barycentric
    std::uint8_t dimension = 0;      ///< of the feature: 0 vertex, 1 edge, 2 face
    std::uint8_t index = 0;          ///< the vertex, or the edge from vertex i to i + 1
};

/// The triangle's point nearest to p.
///
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    a few roundings of the coordinates' differences. Among features at the same
///             distance, the one of lowest dimension is returned.
NearestOnTriangle nearest_on_triangle(const Vec3& p, const Triangle& t);

/// nearest_on_triangle as witness points: `a` is the point p, `b` lies on the triangle.
ClosestPoints point_triangle_distance(const Vec3& p, const Triangle& t);

} // namespace abut
