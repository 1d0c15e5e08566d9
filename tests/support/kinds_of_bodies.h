#pragma once

#include <abut/convex.h>
#include <abut/curved_shapes.h>
#include <abut/model.h>
#include <abut/shapes.h>
#include <abut/world.h>

#include "geometry/point_triangle_distance.h"
#include "math/transform.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

/// One body of each kind of shape for tests, and how far a point is from its surface. The distances
/// are computed from the shapes' definitions, without any code of the queries.
namespace abut::test {

using AnyShape =
    std::variant<Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid, HalfSpace, Convex, Model>;

struct KindOfBody {
    std::string name;
    AnyShape shape;
    bool closed = true; ///< false: an open model, which has no inside
};

inline BodyId add(World& world, const AnyShape& shape, const Pose& pose) {
    return std::visit([&](const auto& each) { return world.add(each, pose); }, shape);
}

/// The distance from an axis, and the height above its middle.
struct AxisPlace {
    double across = 0, height = 0, half = 0;

    AxisPlace(const Vec3& from, const Vec3& to, const Vec3& p) {
        const Vec3 middle = 0.5 * from + 0.5 * to, way = to - from, d = p - middle;
        half = 0.5 * length(way);
        const Vec3 along = half > 0 ? (0.5 / half) * way : Vec3{0, 0, 1};
        height = dot(d, along);
        across = length(d - height * along);
    }
};

/// The signed distance of a point from a polygon in the half-plane of an axis: convex, counter-clockwise.
inline double from_polygon(const std::vector<std::array<double, 2>>& corners, double x, double y) {
    double inside = -HUGE_VAL, outside_sq = HUGE_VAL;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &p = corners[i], &q = corners[(i + 1) % corners.size()];
        const double ex = q[0] - p[0], ey = q[1] - p[1], size = std::hypot(ex, ey);
        const double t = std::clamp(((x - p[0]) * ex + (y - p[1]) * ey) / (size * size), 0.0, 1.0);
        outside_sq =
            std::min(outside_sq, std::pow(x - p[0] - t * ex, 2) + std::pow(y - p[1] - t * ey, 2));
        // The axis is no side of the solid.
        if (p[0] != 0 || q[0] != 0)
            inside = std::max(inside, ((x - p[0]) * ey - (y - p[1]) * ex) / size);
    }
    return inside <= 0 ? inside : std::sqrt(outside_sq);
}

/// The distance of a point of the shape's frame from its surface, negative inside solids that are no
/// models. Exact near the surface only, and for an ellipsoid to first order.
struct DistanceFromSurface {
    Vec3 p;

    double operator()(const Sphere& s) const { return length(p - s.centre) - s.radius; }
    double operator()(const Capsule& c) const {
        const AxisPlace at(c.axis.a, c.axis.b, p);
        return std::hypot(at.across, std::max(std::abs(at.height) - at.half, 0.0)) - c.radius;
    }
    double operator()(const Box3& box) const {
        const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper,
                   half = 0.5 * box.upper - 0.5 * box.lower;
        const double x = std::abs(p.x - middle.x) - half.x, y = std::abs(p.y - middle.y) - half.y,
                     z = std::abs(p.z - middle.z) - half.z;
        return length({std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)}) +
               std::min(std::max({x, y, z}), 0.0);
    }
    double operator()(const Cylinder& c) const {
        const AxisPlace at(c.axis.a, c.axis.b, p);
        return from_polygon(
            {{0, -at.half}, {c.radius, -at.half}, {c.radius, at.half}, {0, at.half}}, at.across,
            at.height);
    }
    double operator()(const Cone& c) const {
        const AxisPlace at(c.base, c.apex, p);
        return from_polygon({{0, -at.half}, {c.radius, -at.half}, {0, at.half}}, at.across,
                            at.height);
    }
    double operator()(const Ellipsoid& e) const {
        const Vec3 d = p - e.centre, &s = e.semi_axes;
        const Vec3 unit{d.x / s.x, d.y / s.y, d.z / s.z};
        const double value = length(unit);
        const Vec3 gradient{unit.x / s.x / value, unit.y / s.y / value, unit.z / s.z / value};
        return (value - 1) / length(gradient);
    }
    double operator()(const HalfSpace& h) const {
        return (dot(h.normal, p) - h.offset) / length(h.normal);
    }
    /// Beyond an edge: less than the distance.
    double operator()(const Convex& convex) const {
        double highest = -HUGE_VAL;
        for (std::size_t i = 0; i < convex.face_count(); ++i) {
            const auto face = convex.face(i);
            const auto& v = convex.vertices();
            const Vec3 normal =
                normalized_or_zero(cross(v[face[1]] - v[face[0]], v[face[2]] - v[face[0]]));
            highest = std::max(highest, dot(normal, p - v[face[0]]));
        }
        return highest;
    }
    double operator()(const Model& model) const {
        const Mesh& mesh = model.mesh();
        double least_sq = HUGE_VAL;
        for (const auto& [i, j, k] : mesh.triangles)
            least_sq = std::min(
                least_sq,
                nearest_on_triangle(p, {mesh.positions[i], mesh.positions[j], mesh.positions[k]})
                    .distance_sq);
        return std::sqrt(least_sq);
    }
};

/// DistanceFromSurface of a point of the world.
inline double distance_from_surface(const AnyShape& shape, const Pose& pose, const Vec3& p) {
    const Transform world = pose;
    const auto& m = world.m;
    const Vec3 d = p - Vec3{m[9], m[10], m[11]};
    const Vec3 own{dot(Vec3{m[0], m[1], m[2]}, d), dot(Vec3{m[3], m[4], m[5]}, d),
                   dot(Vec3{m[6], m[7], m[8]}, d)};
    return std::visit(DistanceFromSurface{own}, shape);
}

/// One body of each kind, of sizes that lie on a grid of quarters.
inline std::vector<KindOfBody> kinds_of_bodies() {
    const Mesh cube = box_mesh({-.75, -.5, -.5}, {.75, .5, .5});
    Mesh sheet{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    std::vector<Vec3> corners;
    for (const double sign : {-1.0, 1.0})
        corners.insert(corners.end(), {{sign, 0, 0}, {0, sign, 0}, {0, 0, sign}});
    return {{"sphere", Sphere{{}, .5}},
            {"capsule", Capsule{{{0, 0, -.75}, {0, 0, .75}}, .25}},
            {"box", Box3{{-.5, -.75, -.25}, {.5, .75, .25}}},
            {"cylinder", Cylinder{{{0, 0, -.75}, {0, 0, .75}}, .5}},
            {"cone", Cone{{0, 0, 1}, {0, 0, -.5}, .75}},
            {"ellipsoid", Ellipsoid{{}, {.5, .75, 1}}},
            {"half-space", HalfSpace{{0, 0, 1}, -.25}},
            {"convex cube", Convex(cube)},
            {"octahedron", Convex(corners)},
            {"closed model", Model(cube)},
            {"model of a ball", Model(sphere_mesh(.75, 12, 8))},
            {"open model", Model(sheet), false}};
}

} // namespace abut::test
