#include "convex/support/support_shape.h"

#include "convex/hull/climb.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Bound of the relative rounding of a point of an inset core.
constexpr double kReachRounding = 0x1p-40;

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
    const double inner = shape.inset > 0 ? shape.inset / std::sqrt(x * x + y * y + z * z) : 0;
    return (a * p / size - inner * x) * shape.axis[0] + (b * q / size - inner * y) * shape.axis[1] +
           (c * r / size - inner * z) * shape.axis[2];
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

SupportShape with_largest_radius(const SupportShape& shape) {
    if (shape.kind != CoreKind::ellipsoid || shape.inset > 0)
        return shape;
    const auto [least, most] = std::minmax_element(shape.half.begin(), shape.half.end());
    if (!(*least > 0))
        return shape;
    SupportShape result = shape;
    if (*least == *most) {
        result.kind = CoreKind::box, result.half = {};
        result.radius += *least, result.reach = 0;
        return result;
    }
    // At the ends of the longest axis the radius of curvature is the smallest: c^2 / a.
    result.inset = *least * (*least / *most);
    result.radius += result.inset;
    result.reach = *most - result.inset + kReachRounding * *most;
    return result;
}

namespace {

/// The segment that a triangle without area is.
std::optional<SolidOfRevolution> as_segment(const SupportShape& triangle) {
    const auto& corners = triangle.corners;
    std::size_t longest = 0;
    const auto edge = [&](std::size_t i) { return corners[(i + 1) % 3] - corners[i]; };
    for (std::size_t i = 1; i < 3; ++i)
        if (length_sq(edge(i)) > length_sq(edge(longest)))
            longest = i;
    if (cross(edge(longest), edge((longest + 1) % 3)) != Vec3{})
        return std::nullopt;
    SupportShape segment;
    segment.radius = triangle.radius;
    const Vec3 half = 0.5 * edge(longest);
    segment.half[2] = segment.reach = length(half);
    segment.reach *= 1 + kReachRounding;
    if (segment.half[2] > 0) {
        const Vec3 z = (1 / segment.half[2]) * half, x = perpendicular(z);
        segment.axis = {x, cross(z, x), z};
    }
    return SolidOfRevolution{segment, corners[longest] + half};
}

} // namespace

std::optional<SolidOfRevolution> as_solid_of_revolution(const SupportShape& shape) {
    const auto turned = [&](std::size_t axis) {
        SupportShape result = shape;
        const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
        result.axis = {shape.axis[x], shape.axis[y], shape.axis[axis]};
        result.half = {shape.half[x], shape.half[y], shape.half[axis]};
        return SolidOfRevolution{result, {}};
    };
    switch (shape.kind) {
    case CoreKind::cylinder:
    case CoreKind::cone:
        return SolidOfRevolution{shape, {}};
    case CoreKind::ellipsoid:
        for (std::size_t k = 0; k < 3; ++k)
            if (shape.half[(k + 1) % 3] == shape.half[(k + 2) % 3])
                return turned(k);
        return std::nullopt;
    case CoreKind::box:
        for (std::size_t k = 0; k < 3; ++k)
            if (shape.half[(k + 1) % 3] == 0 && shape.half[(k + 2) % 3] == 0)
                return turned(k);
        return std::nullopt;
    case CoreKind::triangle:
        return as_segment(shape);
    default:
        return std::nullopt;
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
    result.inset *= factor;
    result.reach *= factor;
    return result;
}

} // namespace abut
