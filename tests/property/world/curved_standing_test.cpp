// Cylinders and cones that stand or lie on a plane, a box, a hull or a mesh have the points that carry them, and
// keep their names while they hardly move.

#include <abut/vector.h>
#include <abut/world.h>

#include "math/transform.h"
#include "simulator/simulator.h"
#include "tests/support/curved_depth.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

struct Ground {
    std::string name;
    AnyShape shape;
};

/// Grounds whose upper side is the plane z = 0, from -3 to 3.
std::vector<Ground> grounds() {
    const auto cells = [](int count) {
        return Model(grid_mesh(count, count, false, false, [](double u, double v) {
            return Vec3{6 * u - 3, 6 * v - 3, 0};
        }));
    };
    const Mesh block = box_mesh({-3, -3, -1}, {3, 3, 0});
    return {{"half-space", HalfSpace{{0, 0, 1}, 0}},
            {"box", Box3{{-3, -3, -1}, {3, 3, 0}}},
            {"hull", Convex(block)},
            {"block", Model(block)},
            {"cells of 1 m", cells(6)},
            {"cells of 10 cm", cells(60)}};
}

/// A body that touches the plane z = 0, and how many points carry it there.
struct Standing {
    std::string name;
    AnyShape shape;
    std::uint32_t points = 0;
    double extent = 0; ///< the largest distance of its points
};

std::vector<Standing> standing_bodies(double r, double l) {
    // A cone that lies on its side: its apex, and a point of its rim.
    const double slant = std::hypot(r, l), base = r * r / slant;
    const Vec3 apex{0, 0, 0}, middle{l * l / slant, 0, r * l / slant};
    EXPECT_GT(base, 0);
    return {{"standing cylinder", Cylinder{{{0, 0, 0}, {0, 0, l}}, r}, 4, 2 * r},
            {"cylinder upside down", Cylinder{{{0, 0, l}, {0, 0, 0}}, r}, 4, 2 * r},
            {"standing cone", Cone{{0, 0, l}, {0, 0, 0}, r}, 4, 2 * r},
            {"lying cylinder", Cylinder{{{-l, 0, r}, {l, 0, r}}, r}, 2, 2 * l},
            {"lying cone", Cone{apex, middle, r}, 2, slant},
            {"ellipsoid", Ellipsoid{{0, 0, r}, {l, r, r}}, 1, 0}};
}

Pose turned_about_z(double angle, const Vec3& place) {
    return {place, {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}};
}

/// The points of a manifold by their names, as if the body were b.
std::map<std::uint64_t, ContactPoint> points_by_name(const ContactManifold& m, bool body_is_a) {
    constexpr std::uint64_t kNumber = (std::uint64_t{1} << 31U) - 1;
    std::map<std::uint64_t, ContactPoint> points;
    for (std::uint32_t i = 0; i < m.count; ++i) {
        ContactPoint p = m.points.at(i);
        if (body_is_a) {
            std::swap(p.point_a, p.point_b);
            const std::uint64_t kind = p.feature >> 62U;
            p.feature = (kind == 1   ? 2
                         : kind == 2 ? 1
                                     : kind)
                            << 62U |
                        (p.feature & kNumber) << 31U | (p.feature >> 31U & kNumber);
        }
        points[p.feature] = p;
    }
    return points;
}

/// The contact of a body on a ground, its points by their names, and their largest distance.
struct Carried {
    ContactManifold manifold;
    std::map<std::uint64_t, ContactPoint> points;
    double extent = 0;
};

Carried carried(World& world, double margin, bool body_is_a) {
    const auto found = world.contact_manifolds(margin);
    EXPECT_EQ(found.size(), 1U);
    if (found.size() != 1)
        return {};
    Carried result{found[0], points_by_name(found[0], body_is_a)};
    EXPECT_EQ(result.points.size(), found[0].count);
    for (const auto& [name, p] : result.points)
        for (const auto& [other, q] : result.points)
            result.extent = std::max(result.extent, length(p.point_b - q.point_b));
    return result;
}

TEST(CurvedStanding, BodiesHaveThePointsThatCarryThem) {
    Random random(20261601);
    for (int round = 0; round < many(12); ++round)
        for (const Ground& ground : grounds()) {
            const double r = random.uniform(0.1, 0.4), l = random.uniform(0.2, 0.6);
            for (const Standing& body : standing_bodies(r, l)) {
                SCOPED_TRACE(body.name + " on " + ground.name + " round " + std::to_string(round));
                const double gap =
                    std::array{0.0, 1e-9, -1e-9, -1e-4, 1e-3}.at(std::size_t(random.integer(0, 4)));
                // At a gap of 0, rounding decides whether they touch.
                const double margin = gap > -1e-5 || random.chance(0.5) ? 0.01 : 0;
                Pose pose = turned_about_z(random.chance(0.3) ? 0 : random.uniform(0, 6),
                                           {random.uniform(-1, 1), random.uniform(-1, 1), gap});
                std::array<Carried, 2> of_orders;
                for (const bool body_is_a : {false, true}) {
                    World world;
                    BodyId id{};
                    if (body_is_a)
                        id = add(world, body.shape, pose);
                    add(world, ground.shape, {});
                    if (!body_is_a)
                        id = add(world, body.shape, pose);
                    Carried& first = of_orders.at(body_is_a ? 1 : 0) =
                        carried(world, margin, body_is_a);
                    ASSERT_EQ(first.manifold.count, body.points);
                    EXPECT_NEAR(first.extent, body.extent, 0.02 * body.extent);
                    EXPECT_LE(length(first.manifold.normal - Vec3{0, 0, body_is_a ? -1.0 : 1.0}),
                              1e-7);
                    for (const auto& [name, p] : first.points) {
                        EXPECT_NEAR(p.depth, -gap, 1e-9);
                        EXPECT_LE(std::abs(p.point_a.z), 1e-9);
                        EXPECT_LE(std::abs(distance_from_surface(body.shape, pose, p.point_b)),
                                  1e-9);
                    }
                    // It stays: nothing changes.
                    for (const auto& [name, p] : carried(world, margin, body_is_a).points) {
                        ASSERT_TRUE(first.points.contains(name));
                        EXPECT_EQ(p.point_a, first.points.at(name).point_a);
                        EXPECT_EQ(p.point_b, first.points.at(name).point_b);
                    }
                    // It slides by a millimetre, and tilts by rounding.
                    Pose moved = pose;
                    moved.translation.x += 1e-3;
                    moved.rotation[1] += 1e-15;
                    world.move(id, moved);
                    for (const auto& [name, p] : carried(world, margin, body_is_a).points)
                        EXPECT_TRUE(first.points.contains(name));
                }
                if (of_orders[0].points.size() != of_orders[1].points.size())
                    continue;
                for (const auto& [name, p] : of_orders[1].points) {
                    ASSERT_TRUE(of_orders[0].points.contains(name)) << "in the other order";
                    EXPECT_LE(length(p.point_b - of_orders[0].points.at(name).point_b), 1e-12);
                }
                if (HasFailure())
                    return;
            }
        }
}

/// A tilted cylinder or cone: the lowest place of its rim, and others within the margin.
TEST(CurvedStanding, OfATiltedBodyTheLowestPlaceComesFirst) {
    Random random(20261602);
    int alone = 0, together = 0;
    for (int round = 0; round < many(20); ++round)
        for (const Ground& ground : grounds()) {
            const double r = random.uniform(0.1, 0.4), l = random.uniform(0.2, 0.6);
            const double tilt = std::pow(10.0, random.uniform(-4, 0)), about = random.uniform(0, 6);
            AnyShape shape = Cylinder{{{0, 0, 0}, {0, 0, l}}, r};
            if (random.chance(0.5))
                shape = Cone{{0, 0, l}, {0, 0, 0}, r};
            SCOPED_TRACE(ground.name + " round " + std::to_string(round) + " tilt " +
                         std::to_string(tilt));
            const double margin = std::pow(10.0, random.uniform(-4, -2)),
                         depth = random.chance(0.5) ? 0.1 * margin : -0.1 * margin;
            Pose pose{{random.uniform(-1, 1), random.uniform(-1, 1), 0},
                      {std::cos(tilt / 2), std::sin(tilt / 2) * std::cos(about),
                       std::sin(tilt / 2) * std::sin(about), 0}};
            pose.translation.z = depth_below({0, 0, 1}, {}, shape, pose) - depth;
            World world;
            add(world, ground.shape, {});
            add(world, shape, pose);
            const Carried found = carried(world, margin, false);
            ASSERT_GE(found.manifold.count, 1U);
            EXPECT_NEAR(found.manifold.points[0].depth, depth, 1e-9);
            for (const auto& [name, p] : found.points) {
                EXPECT_LE(p.depth, found.manifold.points[0].depth);
                EXPECT_GE(p.depth, -margin);
                EXPECT_LE(std::abs(distance_from_surface(shape, pose, p.point_b)), 1e-9);
                EXPECT_LE(length(p.point_a - p.point_b - p.depth * found.manifold.normal), 1e-9);
                EXPECT_NEAR(p.depth, -p.point_b.z, 1e-7);
            }
            // The rim rises from its lowest place by the sine of the tilt times its diameter.
            const double rise = 2 * r * std::sin(tilt);
            if (rise < margin + depth) {
                EXPECT_EQ(found.manifold.count, 4U);
                ++together;
            }
            // The next corner of the rim is a sixteenth of half a turn away, or more.
            if (rise * (1 - std::cos(std::numbers::pi / 16)) / 2 > 1.1 * (margin + depth) &&
                tilt < 0.6) {
                EXPECT_EQ(found.manifold.count, 1U);
                ++alone;
            }
            if (HasFailure())
                return;
        }
    std::cout << together << " on four points, " << alone << " on one\n";
    EXPECT_GT(together, 30);
    EXPECT_GT(alone, 10);
}

TEST(CurvedStanding, ADiscThatReachesOverASmallBoxStandsOnTheCornersOfBoth) {
    for (const bool as_mesh : {false, true}) {
        World world;
        if (as_mesh)
            world.add(Model(box_mesh({-0.1, -0.1, -1}, {0.1, 0.1, 0})), {});
        else
            world.add(Box3{{-0.1, -0.1, -1}, {0.1, 0.1, 0}}, {});
        world.add(Cylinder{{{0, 0, 0}, {0, 0, 1}}, 0.3}, {{0.01, 0.02, -1e-3}});
        const Carried found = carried(world, 0.01, false);
        ASSERT_EQ(found.manifold.count, 4U) << as_mesh;
        for (const auto& [name, p] : found.points) {
            EXPECT_NEAR(p.depth, 1e-3, 1e-9);
            EXPECT_NEAR(std::abs(p.point_a.x), 0.1, 1e-9);
            EXPECT_NEAR(std::abs(p.point_a.y), 0.1, 1e-9);
        }
    }
}

TEST(CurvedStanding, TheMassOfACylinderAndAConeIsThatOfAFineMesh) {
    constexpr std::uint32_t kSides = 256;
    constexpr double kRadius = 0.3, kHeight = 0.8;
    for (const bool is_cone : {false, true}) {
        Mesh mesh{{{0, 0, 0}, {0, 0, kHeight}}, {}};
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const double angle = 2 * std::numbers::pi * i / kSides;
            const double x = kRadius * std::cos(angle), y = kRadius * std::sin(angle);
            mesh.positions.push_back({x, y, 0});
            mesh.positions.push_back({is_cone ? 0 : x, is_cone ? 0 : y, kHeight});
            const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % kSides);
            mesh.triangles.push_back({0, b, a});
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
            mesh.triangles.push_back({1, a + 1, b + 1});
        }
        const simulation::Mass fine = simulation::mass_of(mesh, 700);
        const simulation::Mass mass =
            is_cone ? simulation::mass_of(Cone{{0, 0, kHeight}, {0, 0, 0}, kRadius}, 700)
                    : simulation::mass_of(Cylinder{{{0, 0, 0}, {0, 0, kHeight}}, kRadius}, 700);
        EXPECT_NEAR(mass.mass, fine.mass, 1e-3 * fine.mass);
        EXPECT_LT(length(mass.centre - fine.centre), 1e-9);
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            EXPECT_LT(length(mass.inertia * axis - fine.inertia * axis),
                      1e-3 * length(fine.inertia * axis));
    }
}

/// A barrel stands, and a log with some rolling resistance lies still.
TEST(CurvedStanding, BarrelsConesAndLogsRest) {
    for (const Ground& ground : grounds()) {
        SCOPED_TRACE(ground.name);
        simulation::Simulator simulator({.sleep = false});
        std::visit(
            [&](const auto& shape) {
                if constexpr (requires { simulation::mass_of(shape, 1); })
                    simulator.add(shape, {}, {.density = 0});
            },
            ground.shape);
        simulator.add(Cylinder{{{0, 0, -0.4}, {0, 0, 0.4}}, 0.3}, {{0.13, 0.2, 0.4}});
        simulator.add(Cone{{0, 0, 0.6}, {0, 0, -0.2}, 0.3}, {{1.1, -0.17, 0.2}});
        simulator.add(Cylinder{{{0, -0.5, 0}, {0, 0.5, 0}}, 0.2}, {{-1.2, 0.3, 0.2}},
                      {.rolling = 0.01});
        constexpr int kPerSecond = 60;
        for (int step = 0; step < 5 * kPerSecond; ++step) {
            simulator.step(1.0 / kPerSecond);
            if (step < kPerSecond)
                continue;
            for (const simulation::Body& body : simulator.bodies()) {
                ASSERT_LT(length(body.velocity), 0.01) << "step " << step;
                ASSERT_LT(length(body.spin), 0.05) << "step " << step;
            }
        }
        EXPECT_NEAR(simulator.bodies()[1].position.z, 0.4, 5e-3);
        EXPECT_NEAR(simulator.bodies()[3].position.z, 0.2, 5e-3);
    }
}

} // namespace
} // namespace abut::test
