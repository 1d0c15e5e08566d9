// Supporting planes of convex solids and the deepest points of triangles in them, against the
// shortest motions that part points from solids, and against samples. Each test prints its seed.

#include <abut/convex.h>

#include "convex/body/convex_data.h"
#include "convex/support/support_gap.h"
#include "deform/bodies/deepest_place.h"
#include "deform/bodies/inner_planes.h"
#include "geometry/point_triangle_distance.h"
#include "math/transform.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace abut::test {
namespace {

constexpr int kInnerKinds = 6; ///< box, cylinder, cone, ellipsoid, hull, hull with needles

/// A shape with its planes, and the points that it is the hull of, if it is one.
struct SolidWithPlanes {
    std::optional<Convex> convex;
    SupportShape shape;
    std::unique_ptr<const InnerPlanes> planes;

    SolidWithPlanes(Random& random, int kind) {
        const Transform world = random.pose(1);
        const auto& m = world.m;
        shape.axis = {Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}, Vec3{m[6], m[7], m[8]}};
        shape.centre = {m[9], m[10], m[11]};
        if (kind < 4) {
            constexpr std::array kKinds{CoreKind::box, CoreKind::cylinder, CoreKind::cone,
                                        CoreKind::ellipsoid};
            shape.kind = kKinds[std::size_t(kind)];
            const auto some = [&] { return random.chance(0.2) ? 0.5 : random.uniform(0.02, 1); };
            shape.half = {some(), some(), some()};
            if (kind == 1 || kind == 2)
                shape.half[1] = shape.half[0];
            shape.reach = length({shape.half[0], shape.half[1], shape.half[2]}) * (1 + 1e-9);
        } else {
            std::vector<Vec3> points;
            for (int i = random.integer(8, 120); i > 0; --i) {
                points.push_back(random.in_cube(0.7));
                if (kind == 5) // beside it: faces that are needles
                    points.push_back(points.back() + 1e-9 * random.direction());
            }
            convex.emplace(points);
            const ConvexData& data = convex->data();
            shape.kind = CoreKind::polytope;
            shape.polytope = &data.levels.front().polytope;
            shape.columns = shape.axis;
            shape.first = shape.polytope->vertices.front().at;
            shape.centre = apply(world, shape.first);
            shape.reach = 3;
        }
        planes = make_inner_planes(shape, convex ? &convex->data() : nullptr);
    }
    [[nodiscard]] ConvexSample at(const Vec3& point) const {
        const SupportingPlane plane = planes->nearest(point - shape.centre);
        return {dot(plane.normal, point - shape.centre) - plane.offset, plane.normal};
    }
    [[nodiscard]] double parting_motion(const Vec3& point) const {
        SupportShape of_point;
        of_point.centre = point;
        Vec3 direction;
        return support_gap(of_point, with_largest_radius(shape), 0, SupportDepths::yes, direction)
            .distance;
    }
};

TEST(InnerPlanes, DepthsOfPointsAgainstTheShortestMotion) {
    Random random(31415);
    for (int kind = 0; kind < kInnerKinds; ++kind) {
        int inside = 0, points = 0;
        double off = 0, above = 0, unit = 0;
        for (int round = 0; round < many(40); ++round) {
            const SolidWithPlanes solid(random, kind);
            ASSERT_NE(solid.planes, nullptr);
            Vec3 middle = solid.shape.centre;
            if (solid.convex)
                for (const HullVertex& v : solid.shape.polytope->vertices)
                    middle = middle + 1.0 / double(solid.shape.polytope->vertices.size()) *
                                          ((v.at - solid.shape.first).x * solid.shape.columns[0] +
                                           (v.at - solid.shape.first).y * solid.shape.columns[1] +
                                           (v.at - solid.shape.first).z * solid.shape.columns[2]);
            for (int k = 0; k < 30; ++k) {
                // Also in the planes and on the axes of symmetry, and in the middle.
                Vec3 point = middle;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    point = point + (random.chance(0.3)   ? 0
                                     : random.chance(0.3) ? 1e-14
                                                          : random.uniform(-1, 1)) *
                                        (solid.convex ? 0.5 : solid.shape.half[axis]) *
                                        solid.shape.axis[axis];
                const ConvexSample sample = solid.at(point);
                unit = std::max(unit, std::abs(length(sample.gradient) - 1));
                // No point of the solid is beyond its plane.
                above = std::max(
                    above, dot(sample.gradient, farthest(solid.shape, sample.gradient)) -
                               (dot(sample.gradient, point - solid.shape.centre) - sample.value));
                ++points;
                const double motion = solid.parting_motion(point);
                if (!(motion < -1e-9)) {
                    EXPECT_GT(sample.value, -1e-8);
                    continue;
                }
                ++inside;
                off = std::max(off, std::abs(sample.value - motion));
            }
        }
        std::cout << "kind " << kind << ": " << inside << " of " << points
                  << " points inside, depth off by " << off << ", above the plane " << above
                  << '\n';
        EXPECT_LT(off, 1e-12);
        EXPECT_LT(above, 1e-14);
        EXPECT_LT(unit, 1e-14);
        EXPECT_GT(inside, points / 4);
    }
}

/// The search measures a few depths. Each was a search by itself, and there was a linear program
/// over all planes so far after each: 0.2 ms for a large triangle.
TEST(InnerPlanes, DeepestPlacesOfTrianglesTakeFewSamples) {
    Random random(27182);
    for (int kind = 0; kind < kInnerKinds; ++kind) {
        std::size_t samples = 0, most = 0, deep = 0;
        double worst = 0;
        const int triangles = many(120);
        for (int round = 0; round < triangles; ++round) {
            const SolidWithPlanes solid(random, kind);
            const double size = std::pow(10, random.uniform(-2, 2));
            Triangle t;
            for (Vec3& corner : t)
                corner = solid.shape.centre + random.in_cube(0.2) + size * random.in_cube();
            if (random.chance(0.1))
                t[1] = t[2];
            if (random.chance(0.1))
                t[2] = 0.3 * t[0] + 0.7 * t[1];
            std::size_t taken = 0;
            const auto sample = [&](const Vec3& point) {
                ++taken;
                return solid.at(point);
            };
            const Vec3 start = nearest_on_triangle(solid.shape.centre, t).point;
            const Vec3 place = deepest_place(t, start, sample, 0x1p-44 * size);
            samples += taken, most = std::max(most, taken);
            const double depth = solid.at(place).value;
            deep += depth < -0.01 ? 1 : 0;
            ASSERT_LT(length(nearest_on_triangle(place, t).point - place), 1e-14 * (1 + size));
            for (int k = 0; k < 100 && depth < 0; ++k) { // all over it, and beside the place
                double r = random.uniform(0, 1), s = random.uniform(0, 1);
                if (r + s > 1)
                    r = 1 - r, s = 1 - s;
                Vec3 point = t[0] + r * (t[1] - t[0]) + s * (t[2] - t[0]);
                point = place + std::pow(10, -random.uniform(0, 5)) * (point - place);
                worst = std::max(worst, (depth - solid.at(point).value) / (1 + size));
            }
        }
        std::cout << "kind " << kind << ": " << deep << " of " << triangles << " deep, "
                  << double(samples) / triangles << " samples, at most " << most
                  << ", others deeper by " << worst << '\n';
        EXPECT_LT(worst, 1e-12);
        EXPECT_LT(double(samples), 32.0 * triangles);
        EXPECT_GT(deep, std::size_t(triangles) / 8);
    }
}

TEST(InnerPlanes, ShapesWithoutAnInsideHaveNone) {
    SupportShape flat;
    flat.half = {1, 0, 1};
    EXPECT_EQ(make_inner_planes(flat, nullptr), nullptr);
    flat.half = {1, 1, 1};
    EXPECT_NE(make_inner_planes(flat, nullptr), nullptr);
    flat.radius = 0.1;
    EXPECT_EQ(make_inner_planes(flat, nullptr), nullptr);
    const Convex square(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
    SupportShape polygon;
    polygon.kind = CoreKind::polytope;
    EXPECT_EQ(make_inner_planes(polygon, &square.data()), nullptr);
}

} // namespace
} // namespace abut::test
