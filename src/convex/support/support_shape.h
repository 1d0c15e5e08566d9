#pragma once

#include <abut/types.h>

#include "convex/hull/polytope.h"
#include "math/vector.h"

#include <array>
#include <cstdint>
#include <optional>

namespace abut {

enum class CoreKind : std::uint8_t {
    box,       ///< half[k] along axis[k]; also a rectangle, a segment or a point
    cylinder,  ///< along axis[2], of radius half[0] = half[1]; half of its length is half[2]
    cone,      ///< as the cylinder around it; its apex is at half[2] along axis[2]
    ellipsoid, ///< semi-axes half[k] along axis[k]
    triangle,  ///< of three corners
    polytope,  ///< a hull under a linear map
};

/// A convex solid that is known by its farthest points: all points at most `radius` from a core.
///
/// Points of the core are given relative to `centre`. So the distance of two shapes keeps its digits
/// however far both are from the world's origin.
struct SupportShape {
    CoreKind kind = CoreKind::box;
    Vec3 centre;
    std::array<Vec3, 3> axis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< orthonormal
    std::array<double, 3> half{};
    double radius = 0;
    /// The core of an ellipsoid lies this far inside of it, along the normals: at most the smallest
    /// radius of its curvature, so that the core is convex.
    double inset = 0;
    double reach = 0;                   ///< no point of the core is farther from the centre
    Triangle corners{};                 ///< of a triangle
    const Polytope* polytope = nullptr; ///< not owned
    std::array<Vec3, 3> columns{};      ///< of the polytope's linear map
    Vec3 first;                         ///< the polytope's vertex that is mapped to the centre
};

/// A length with the sign of a number; that of 0 is positive.
inline double with_sign(double size, double sign) {
    return sign < 0 ? -size : size;
}

/// A point of the core that is farthest along a direction, relative to the centre. Any point of the
/// core for a zero direction.
Vec3 farthest(const SupportShape& shape, const Vec3& direction);

/// The same points as core and radius, with as large a radius as the shape allows. So a ball is a
/// point with a radius, and a shape that is nearly a ball has a small core.
SupportShape with_largest_radius(const SupportShape& shape);

/// A shape whose core is a solid of revolution about axis[2].
struct SolidOfRevolution {
    SupportShape shape;
    Vec3
        shift; ///< of its centre from that of the original shape, which the world's origin may round
};
/// The shape with its axes exchanged so that it is one; none if it has no such axis. A triangle
/// without area becomes a segment.
std::optional<SolidOfRevolution> as_solid_of_revolution(const SupportShape& shape);

/// A triangle of the world.
SupportShape support_of(const Triangle& triangle);

/// The shape with all lengths multiplied by a factor. The centre does not change.
SupportShape scaled(const SupportShape& shape, double factor);

} // namespace abut
