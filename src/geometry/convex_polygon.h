#pragma once

#include "math/vector.h"

#include <cstddef>
#include <span>

/// Convex polygons in space, as lists of corners.
namespace abut {

/// The mean of the corners.
inline Vec3 mean(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points)
        sum = sum + p;
    return (1.0 / static_cast<double>(points.size())) * sum;
}

/// The area of a convex polygon.
inline double area_of(std::span<const Vec3> polygon) {
    double doubled = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        doubled += length(cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    return doubled / 2;
}

/// The centroid of a convex polygon.
inline Vec3 centroid_of(std::span<const Vec3> polygon) {
    Vec3 sum;
    double area = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const double part = length(cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
        area += part;
        sum = sum + part * ((polygon[i - 1] - polygon[0]) + (polygon[i] - polygon[0]));
    }
    return area > 0 ? polygon[0] + (1 / (3 * area)) * sum : mean(polygon);
}

} // namespace abut
