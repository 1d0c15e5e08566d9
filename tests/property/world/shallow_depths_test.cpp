// Solids that stand on the middle of a mesh's flat top, at gaps and depths from rounding size to 1e-6: the
// normal is that of the top, and moving by the depth along it parts them. Also deep ones.

#include <abut/vector.h>
#include <abut/world.h>

#include "geometry/point_triangle_distance.h"
#include "math/transform.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <variant>
#include <vector>

namespace abut::test {
namespace {

using Standing = std::variant<Box3, Convex, Cylinder, Cone, Ellipsoid>;

/// Solids above z = 0 whose lowest points are at z = 0, near the origin.
std::vector<std::pair<std::string, Standing>> standing_solids() {
    const auto convex = [](std::vector<Vec3> points) { return Convex(points); };
    return {
        {"box", Box3{{-0.5, -0.25, 0}, {0.5, 0.25, 0.75}}},
        {"convex on a vertex", convex({{0, 0, 0}, {1, 0, 1}, {-0.5, 0.7, 1}, {-0.5, -0.7, 1}})},
        {"convex on an edge", convex({{-0.5, 0, 0},
                                      {0.5, 0, 0},
                                      {-0.5, 0.5, 1},
                                      {-0.5, -0.5, 1},
                                      {0.5, 0.5, 1},
                                      {0.5, -0.5, 1}})},
        {"cylinder", Cylinder{{{0, 0, 0}, {0, 0, 1}}, 0.3}},
        {"lying cylinder", Cylinder{{{-0.5, 0, 0.3}, {0.5, 0, 0.3}}, 0.3}},
        {"cone", Cone{{0, 0, 1}, {0, 0, 0}, 0.4}},
        {"cone on its apex", Cone{{0, 0, 0}, {0, 0, 1}, 0.4}},
        {"ellipsoid", Ellipsoid{{0, 0, 0.3}, {0.5, 0.4, 0.3}}},
    };
}

/// Meshes with a flat top at z = 0: a closed box, and open floors of two triangles and of many.
std::array<Model, 3> flat_tops() {
    const auto floor = [](int n) {
        return Model(grid_mesh(n, n, false, false, [](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, 0};
        }));
    };
    return {Model(box_mesh({-2, -2, -1}, {2, 2, 0})), floor(1), floor(16)};
}

/// b, placed in a frame that c places.
Pose placed_in_frame(const Pose& c, const Pose& b) {
    const auto &p = c.rotation, &q = b.rotation;
    Pose result;
    result.rotation = {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
                       p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                       p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
                       p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
    result.translation = apply(Transform(c), b.translation);
    return result;
}

BodyId add(World& world, const Standing& solid, const Pose& pose) {
    return std::visit([&](const auto& shape) { return world.add(shape, pose); }, solid);
}

TEST(ShallowDepths, NormalsAreThoseOfTheFlatTop) {
    Random random(20261130);
    const auto solids = standing_solids();
    const std::array<Model, 3> tops = flat_tops();
    for (int round = 0; round < many(12); ++round)
        for (const auto& [name, solid] : solids)
            for (std::size_t top = 0; top < tops.size(); ++top) {
                const double size = std::pow(10.0, random.integer(-17, -6)),
                             gap = random.chance(0.1)   ? 0
                                   : random.chance(0.5) ? size
                                                        : -size;
                SCOPED_TRACE(name + " on top " + std::to_string(top) + ", gap " +
                             std::to_string(gap * 1e12) + "e-12, round " + std::to_string(round));
                Pose on_top; // often at vertices, edges and diagonals of the top
                on_top.translation = {0.125 * random.integer(-6, 6), 0.125 * random.integer(-6, 6),
                                      gap};
                const double turn = random.chance(0.5) ? 0 : random.uniform(0, 3);
                on_top.rotation = {std::cos(turn), 0, 0, std::sin(turn)};
                const Pose frame = random.chance(0.6) ? random.pose(5) : Pose{};
                const Vec3 up = apply(Transform(frame), Vec3{0, 0, 1}) - frame.translation;
                World world;
                const bool solid_first = random.chance(0.5);
                if (solid_first)
                    add(world, solid, placed_in_frame(frame, on_top));
                world.add(tops.at(top), frame);
                if (!solid_first)
                    add(world, solid, placed_in_frame(frame, on_top));
                const auto check = [&](const Vec3& normal) {
                    EXPECT_LE(length((solid_first ? -normal : normal) - up), 1e-9 + 1e-14 / size);
                };
                const std::vector<BodyGap> found = world.within(1e-5);
                ASSERT_EQ(found.size(), 1U);
                EXPECT_NEAR(found[0].distance, gap, 2e-13);
                check(found[0].normal);
                const auto manifolds = world.contact_manifolds(1e-5);
                ASSERT_FALSE(manifolds.empty());
                for (const ContactManifold& manifold : manifolds)
                    check(manifold.normal);
            }
}

TEST(ShallowDepths, SolidsThatReachOverABorderLeaveUpwards) {
    Random random(20261202);
    const auto solids = standing_solids();
    const std::array<Model, 3> tops = flat_tops();
    for (int round = 0; round < many(60); ++round)
        for (const auto& [name, solid] : solids) {
            if (name == "convex on a vertex" || name == "cone on its apex" || name == "ellipsoid")
                continue; // these touch at a point
            const std::size_t top = static_cast<std::size_t>(random.integer(0, 2));
            const double depth = std::pow(10.0, -random.uniform(3, 13));
            SCOPED_TRACE(name + " on top " + std::to_string(top) + ", depth " +
                         std::to_string(depth * 1e12) + "e-12, round " + std::to_string(round));
            // Half of it or less is beyond the border, or beyond a corner.
            Pose on_top;
            on_top.translation = {(random.chance(0.5) ? 2 : -2) + random.uniform(-0.1, 0.1),
                                  random.uniform(-1.95, 1.95), -depth};
            on_top.rotation = {1, 0, 0, random.chance(0.5) ? 0 : random.uniform(-0.3, 0.3)};
            const Pose frame = random.chance(0.6) ? random.pose(5) : Pose{};
            const Vec3 up = apply(Transform(frame), Vec3{0, 0, 1}) - frame.translation;
            World world;
            world.add(tops.at(top), frame);
            const BodyId body = add(world, solid, placed_in_frame(frame, on_top));
            const std::vector<BodyGap> found = world.penetration();
            ASSERT_EQ(found.size(), 1U);
            EXPECT_LE(length(found[0].normal - up), 1e-9 + 1e-14 / depth);
            EXPECT_NEAR(found[0].distance, -depth, 2e-13);
            // The points are those that the motion brings together, on the top.
            const Vec3 on_surface = apply(inverse(Transform(frame)), found[0].point_a);
            EXPECT_NEAR(on_surface.z, 0, 2e-13);
            EXPECT_LE(std::max(std::abs(on_surface.x), std::abs(on_surface.y)), 2 + 1e-12);
            const Mesh& mesh = tops.at(top).mesh();
            Triangle named{};
            for (std::size_t k = 0; k < 3; ++k)
                named[k] =
                    apply(Transform(frame), mesh.positions[mesh.triangles[found[0].triangle_a][k]]);
            EXPECT_LE(nearest_on_triangle(found[0].point_a, named).distance_sq, 1e-24);
            Pose away = placed_in_frame(frame, on_top);
            away.translation = away.translation + (1e-11 - found[0].distance) * found[0].normal;
            world.move(body, away);
            EXPECT_TRUE(world.collide().empty());
        }
}

TEST(ShallowDepths, MovingByTheDepthPartsCurvedSolidsFromModels) {
    Random random(20261201);
    const auto solids = standing_solids();
    int deep = 0, still = 0;
    for (int round = 0; round < many(60); ++round)
        for (const auto& [name, solid] : solids) {
            if (std::holds_alternative<Box3>(solid) || std::holds_alternative<Convex>(solid))
                continue;
            const Vec3 half{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
            Pose pose = random.chance(0.5) ? random.pose(0) : Pose{};
            pose.translation = {0.25 * random.integer(-3, 3), 0.25 * random.integer(-3, 3),
                                0.25 * random.integer(-3, 3)};
            World world;
            world.add(Model(box_mesh(-half, half)), {});
            const BodyId body = add(world, solid, pose);
            const std::vector<BodyGap> found = world.penetration();
            if (found.empty() || found[0].distance > -1e-3)
                continue;
            ++deep;
            pose.translation = pose.translation + (1e-9 - found[0].distance) * found[0].normal;
            world.move(body, pose);
            // It may meet other triangles there.
            still += world.collide().empty() ? 0 : 1;
        }
    EXPECT_GT(deep, many(60));
    EXPECT_LT(still, deep / 5);
    std::cout << still << " of " << deep << " still meet\n";
}

} // namespace
} // namespace abut::test
