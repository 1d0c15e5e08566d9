#pragma once

#include <abut/types.h>

#include "math/vector.h"

#include <array>
#include <cstdint>

namespace abut {

/// What a point lies on: vertex i of a triangle, its edge from vertex i to the next, or its face.
struct TriangleFeature {
    Feature kind = Feature::face;
    std::uint8_t index = 0;
};

/// Two points and their squared distance; of triangles, also what the points lie on.
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

/// Accuracy    the foot to a few roundings of the coordinates' differences, whatever the width of
///             a needle. A triangle that is flat to rounding has none.
TriangleFoot foot_within(const Vec3& p, const Triangle& t);

/// The triangle's point nearest to a point, and the feature that it lies on.
struct NearestOnTriangle {
    double distance_sq = 0;
    Vec3 point;
    std::array<double, 3> weights{}; ///< barycentric
    std::uint8_t dimension = 0;      ///< of the feature: 0 vertex, 1 edge, 2 face
    std::uint8_t index = 0;          ///< vertex, or edge from vertex i to i + 1
};

/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    a few roundings of the coordinates' differences. Of features at the same distance,
///             the one of least dimension.
NearestOnTriangle nearest_on_triangle(const Vec3& p, const Triangle& t);

/// The same, as closest points: `a` is the point, `b` lies on the triangle.
ClosestPoints point_triangle_distance(const Vec3& p, const Triangle& t);

} // namespace abut
