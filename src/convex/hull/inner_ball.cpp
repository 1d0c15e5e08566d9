#include "convex/hull/inner_ball.h"

#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

constexpr int kSteps = 48;

/// The half-space dot(normal, p) < offset.
struct Plane {
    Vec3 normal; ///< unit vector, rounded
    double offset = 0;
    double error = 0; ///< bounds the error of a depth below the plane, for points of the box
};

Box3 box_of(std::span<const Vec3> vertices) {
    Box3 box;
    for (const Vec3& p : vertices)
        extend(box, p);
    return box;
}

/// A point of the hull, to rounding.
Vec3 mean_of(std::span<const Vec3> vertices) {
    Vec3 sum;
    for (const Vec3& p : vertices)
        sum = sum + (p - vertices.front());
    return vertices.empty() ? Vec3{} : vertices.front() + (1.0 / double(vertices.size())) * sum;
}

/// The planes relative to the middle of the box, so that rounding depends on its size alone. Empty
/// if a triangle has no area to rounding.
std::vector<Plane> planes_of(std::span<const Vec3> vertices,
                             std::span<const IndexTriangle> triangles, const Vec3& middle,
                             double size) {
    std::vector<Plane> planes;
    planes.reserve(triangles.size());
    for (const IndexTriangle& t : triangles) {
        const Vec3 p = vertices[t[0]] - middle, u = vertices[t[1]] - middle - p,
                   v = vertices[t[2]] - middle - p;
        const Vec3 normal = cross(u, v);
        const double scale = 1 / length(normal);
        // The normal is off by a few roundings of |u| |v|, or by those of the corners' differences.
        const double error = 64 * 0x1p-53 * scale * size * size;
        if (!std::isfinite(scale))
            return {};
        planes.push_back({scale * normal, scale * dot(normal, p), error * size});
    }
    return planes;
}

} // namespace

InnerBall inner_ball(std::span<const Vec3> vertices, std::span<const IndexTriangle> triangles) {
    const Box3 box = box_of(vertices);
    const Vec3 middle = box.lower + 0.5 * (box.upper - box.lower);
    const double size = length(box.upper - box.lower);
    const std::vector<Plane> planes = planes_of(vertices, triangles, middle, size);
    InnerBall best{middle, 0};
    Vec3 at;
    double step = 0.25 * size;
    for (int i = 0; i < kSteps; ++i) {
        double least = std::numeric_limits<double>::infinity();
        const Plane* nearest = nullptr;
        for (const Plane& plane : planes)
            if (const double depth = plane.offset - dot(plane.normal, at) - plane.error;
                depth < least)
                least = depth, nearest = &plane;
        if (nearest == nullptr)
            break;
        if (least > best.radius)
            best = {middle + at, least};
        at = at - step * nearest->normal;
        step *= 0.9;
    }
    // Allow for rounding of the middle and of a length.
    best.radius = best.radius * (1 - 0x1p-40) - 0x1p-48 * (max_abs(best.middle) + size);
    return best.radius > 0 ? best : InnerBall{mean_of(vertices), 0};
}

} // namespace abut
