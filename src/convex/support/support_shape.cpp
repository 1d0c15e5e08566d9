#include "convex/support/support_shape.h"

#include "convex/hull/climb.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

double with_sign(double size, double sign) {
    return sign < 0 ? -size : size;
}

/// The farthest point of a disc of this radius across axis[2].
Vec3 rim_point(const SupportShape& shape, double x, double y) {
    const double across = std::sqrt(x * x + y * y);
    if (!(across > 0))
        return {};
    const double scale = shape.half[0] / across;
    return scale * x * shape.axis[0] + scale * y * shape.axis[1];
}

Vec3 farthest_of_cone(const SupportShape& shape, double x, double y, double z) {
    const double across = std::sqrt(x * x + y * y), h = shape.half[2];
    if (2 * h * z >= shape.half[0] * across)
        return h * shape.axis[2];
    return rim_point(shape, x, y) - h * shape.axis[2];
}

Vec3 farthest_of_ellipsoid(const SupportShape& shape, double x, double y, double z) {
    const auto& [a, b, c] = shape.half;
    const double p = a * x, q = b * y, r = c * z;
    const double size = std::sqrt(p * p + q * q + r * r);
    if (!(size > 0))
        return {};
    return (a * p / size) * shape.axis[0] + (b * q / size) * shape.axis[1] +
           (c * r / size) * shape.axis[2];
}

Vec3 farthest_of_polytope(const SupportShape& shape, const Vec3& direction) {
    const auto& [x, y, z] = shape.columns;
    const Vec3 pulled{dot(x, direction), dot(y, direction), dot(z, direction)};
    const Vec3 v = shape.polytope->vertices[farthest(*shape.polytope, pulled)].at - shape.first;
    return v.x * x + v.y * y + v.z * z;
}

} // namespace

Vec3 farthest(const SupportShape& shape, const Vec3& direction) {
    if (shape.kind == CoreKind::triangle)
        return *std::max_element(
            shape.corners.begin(), shape.corners.end(),
            [&](const Vec3& p, const Vec3& q) { return dot(p, direction) < dot(q, direction); });
    if (shape.kind == CoreKind::polytope)
        return farthest_of_polytope(shape, direction);
    const double x = dot(shape.axis[0], direction), y = dot(shape.axis[1], direction),
                 z = dot(shape.axis[2], direction);
    switch (shape.kind) {
    case CoreKind::cylinder:
        return rim_point(shape, x, y) + with_sign(shape.half[2], z) * shape.axis[2];
    case CoreKind::cone:
        return farthest_of_cone(shape, x, y, z);
    case CoreKind::ellipsoid:
        return farthest_of_ellipsoid(shape, x, y, z);
    default:
        return with_sign(shape.half[0], x) * shape.axis[0] +
               with_sign(shape.half[1], y) * shape.axis[1] +
               with_sign(shape.half[2], z) * shape.axis[2];
    }
}

SupportShape support_of(const Triangle& triangle) {
    SupportShape shape;
    shape.kind = CoreKind::triangle;
    shape.centre = triangle[0];
    for (std::size_t i = 1; i < 3; ++i) {
        shape.corners[i] = triangle[i] - triangle[0];
        shape.reach = std::max(shape.reach, length(shape.corners[i]));
    }
    return shape;
}

SupportShape scaled(const SupportShape& shape, double factor) {
    SupportShape result = shape;
    for (std::size_t k = 0; k < 3; ++k) {
        result.half[k] *= factor;
        result.corners[k] = factor * result.corners[k];
        result.columns[k] = factor * result.columns[k];
    }
    result.radius *= factor;
    result.reach *= factor;
    return result;
}

} // namespace abut
