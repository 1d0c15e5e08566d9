#pragma once

#include <abut/convex.h>
#include <abut/shapes.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "world/narrow_phase/offset_surface.h"

#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

/// Cylinders, cones and ellipsoids for tests, between polytopes inside and around them.
namespace abut::test {

using Curved = std::variant<Cylinder, Cone, Ellipsoid>;

/// A shape of about the size of 1, at about the origin. In: kind: 0 to 2.
inline Curved curved_shape(Random& random, int kind) {
    const Vec3 a = random.in_cube(0.6), b = a + random.uniform(0.3, 1.5) * random.direction();
    const double radius = random.uniform(0.1, 0.8);
    if (kind == 0)
        return Cylinder{{a, b}, radius};
    if (kind == 1)
        return Cone{a, b, radius};
    return Ellipsoid{
        a, {random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)}};
}

/// How many kinds upright_solid knows. The curved ones come first.
inline constexpr int kUprightKinds = 6, kUprightCurvedKinds = 3;

/// A solid about the origin whose axis is z. Equal lengths, or lengths on a grid, make its features
/// parallel or coincident with those of another one.
///
/// In          kind: 0 to 5, for a cylinder, a cone, an ellipsoid (sometimes of revolution), a
///             ball, a capsule or a box. Shape: a variant of these. The radius of a cylinder or
///             cone is a, and half of its height b.
template <typename Shape>
Shape upright_solid(Random& random, int kind, double a, double b, double c) {
    switch (kind) {
    case 0:
        return Cylinder{{{0, 0, -b}, {0, 0, b}}, a};
    case 1:
        return Cone{{0, 0, b}, {0, 0, -b}, a};
    case 2:
        return Ellipsoid{{}, {a, random.chance(0.3) ? a : b, c}};
    case 3:
        return Sphere{{}, a};
    case 4:
        return Capsule{{{0, 0, -a}, {0, 0, a}}, b};
    default:
        return Box3{{-a, -b, -c}, {a, b, c}};
    }
}

inline BodyShape body_shape(const Curved& curved) {
    return std::visit([](const auto& shape) { return shape_of(shape); }, curved);
}
inline BodyId add(World& world, const Curved& curved, const Pose& pose) {
    return std::visit([&](const auto& shape) { return world.add(shape, pose); }, curved);
}

/// The hull of many points of the surface.
inline Convex inside_of(const Curved& curved) {
    const BodyShape body = body_shape(curved);
    const SupportShape& solid = std::get<CurvedShape>(body).solid;
    std::vector<Vec3> points;
    const int count = solid.kind == CoreKind::ellipsoid ? 300 : 48;
    for (int i = 0; i < count; ++i) {
        const double ring = 2 * std::numbers::pi * i / count;
        if (solid.kind == CoreKind::ellipsoid) { // along a spiral from pole to pole
            const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
            const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
            points.push_back(solid.centre + r * std::cos(angle) * solid.half[0] * solid.axis[0] +
                             r * std::sin(angle) * solid.half[1] * solid.axis[1] +
                             z * solid.half[2] * solid.axis[2]);
            continue;
        }
        const Vec3 rim = solid.half[0] *
                         (std::cos(ring) * solid.axis[0] + std::sin(ring) * solid.axis[1]),
                   top = solid.half[2] * solid.axis[2];
        points.push_back(solid.centre + rim - top);
        points.push_back(solid.centre + top + (solid.kind == CoreKind::cylinder ? rim : Vec3{}));
    }
    return Convex(points);
}
/// A polytope around the shape.
inline Convex around(const Curved& curved) {
    const BodyShape body = body_shape(curved);
    const OffsetSurface outline = offset_surface_of(body);
    std::vector<Vec3> points;
    for (const Vec3& p : outline.surface.mesh().positions)
        points.push_back(apply(outline.body_from_surface, p));
    return Convex(points);
}

} // namespace abut::test
