// Balls and capsules that touch several walls of one mesh: a contact for each wall, and one for a floor of
// many triangles.

#include <abut/vector.h>
#include <abut/world.h>

#include "math/transform.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

constexpr double kDegreeOfAngle = std::numbers::pi / 180;

/// Two planes that meet in the line x = z = 0 and rise at an angle on both sides, in cells.
Mesh valley_of(double angle, int cells) {
    return grid_mesh(2 * cells, cells, false, false, [=](double u, double v) {
        const double x = 4 * u - 2;
        return Vec3{x * std::cos(angle), 4 * v - 2, std::abs(x) * std::sin(angle)};
    });
}

Pose pose_near_or_far(Random& random) {
    return random.pose(random.chance(0.3) ? 1e4 : 1);
}

/// The contacts of a mesh and a shape at a place, both moved by a pose.
std::vector<ContactManifold> walls_of(const Mesh& mesh, const auto& shape, const Vec3& place,
                                      const Pose& pose, bool shape_first, double margin) {
    World world;
    const auto add_mesh = [&] { world.add(Model(mesh), pose); };
    if (!shape_first)
        add_mesh();
    world.add(shape, Pose{apply(Transform(pose), place), pose.rotation});
    if (shape_first)
        add_mesh();
    return world.contact_manifolds(margin);
}

/// Normals from the mesh to the shape, in the frame of a pose.
std::vector<Vec3> upward_normals(const std::vector<ContactManifold>& found, const Pose& pose,
                                 bool shape_first) {
    std::vector<Vec3> normals;
    normals.reserve(found.size());
    for (const ContactManifold& m : found)
        normals.push_back((shape_first ? -1 : 1) * pull_back(Transform(pose), m.normal));
    std::sort(normals.begin(), normals.end(),
              [](const Vec3& p, const Vec3& q) { return p.x < q.x; });
    return normals;
}

TEST(RoundedWalls, AValleyOfAnyAngleHoldsABallAndACapsuleOnBothSides) {
    Random random(20261401);
    std::cout << "seed 20261401\n";
    for (int round = 0; round < many(300); ++round) {
        const double angle = random.uniform(3, 75) * kDegreeOfAngle,
                     radius = random.uniform(0.1, 0.5);
        const int cells = random.integer(1, 12);
        const double depth = random.chance(0.3) ? 0 : radius * random.uniform(-0.02, 0.02);
        const double margin = random.uniform(0.021, 0.1) * radius;
        const Vec3 centre{0, random.uniform(-1, 1), (radius - depth) / std::cos(angle)};
        const Pose pose = pose_near_or_far(random);
        const bool first = random.chance(0.5);
        SCOPED_TRACE("round " + std::to_string(round) + " angle " + std::to_string(angle) +
                     " depth " + std::to_string(depth / radius) + " margin " +
                     std::to_string(margin / radius));
        for (const bool is_capsule : {false, true}) {
            const Vec3 half{0, 0.3, 0};
            const auto found =
                is_capsule ? walls_of(valley_of(angle, cells), Capsule{{-half, half}, radius},
                                      centre, pose, first, margin)
                           : walls_of(valley_of(angle, cells), Sphere{{}, radius}, centre, pose,
                                      first, margin);
            ASSERT_EQ(found.size(), 2U);
            const auto normals = upward_normals(found, pose, first);
            EXPECT_LE(length(normals[0] - Vec3{-std::sin(angle), 0, std::cos(angle)}), 1e-7);
            EXPECT_LE(length(normals[1] - Vec3{std::sin(angle), 0, std::cos(angle)}), 1e-7);
            EXPECT_NE(found[0].region, found[1].region);
            for (const ContactManifold& m : found) {
                EXPECT_EQ(m.count, is_capsule ? 2U : 1U);
                for (std::uint32_t i = 0; i < m.count; ++i)
                    EXPECT_NEAR(m.points[i].depth, depth, 1e-7);
            }
        }
    }
}

TEST(RoundedWalls, ACornerOfThreeWallsHoldsABall) {
    Mesh room = box_mesh({0, 0, 0}, {2, 2, 2});
    std::erase_if(room.triangles, [&](const auto& t) { // those of the far walls
        const Vec3 &p = room.positions[t[0]], &q = room.positions[t[1]], &r = room.positions[t[2]];
        const auto all_two = [](double x, double y, double z) {
            return x == 2 && y == 2 && z == 2;
        };
        return all_two(p.x, q.x, r.x) || all_two(p.y, q.y, r.y) || all_two(p.z, q.z, r.z);
    });
    Random random(20261402);
    for (int round = 0; round < many(100); ++round) {
        const Pose pose = pose_near_or_far(random);
        const double radius = random.uniform(0.1, 0.9), overlap = 0.01 * radius;
        const double at = radius - overlap;
        const auto found = walls_of(room, Sphere{{}, radius}, {at, at, at}, pose,
                                    random.chance(0.5), 0.02 * radius);
        ASSERT_EQ(found.size(), 3U) << "round " << round;
        for (const ContactManifold& m : found)
            EXPECT_NEAR(m.points[0].depth, overlap, 1e-7);
    }
}

TEST(RoundedWalls, ACornerOfThreeWallsHoldsACapsuleByItsDepthInEach) {
    // Each wall in cells: places of one wall beside the capsule must not count as places of another.
    Random random(20261407);
    std::cout << "seed 20261407\n";
    int walls = 0;
    for (int round = 0; round < many(300); ++round) {
        const int cells = random.integer(1, 10);
        Mesh room;
        for (const int axis : {0, 1, 2}) {
            const Mesh wall = grid_mesh(cells, cells, false, false, [=](double u, double v) {
                const double x = 4 * u, y = 4 * v;
                return axis == 0 ? Vec3{0, x, y} : axis == 1 ? Vec3{x, 0, y} : Vec3{x, y, 0};
            });
            const auto first = static_cast<std::uint32_t>(room.positions.size());
            room.positions.insert(room.positions.end(), wall.positions.begin(),
                                  wall.positions.end());
            for (const auto& t : wall.triangles)
                room.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        }
        const double radius = random.uniform(0.3, 1.2);
        const auto place = [&] { return random.uniform(0.5, 1.3) * radius; };
        const Vec3 from{place(), place(), place()};
        const Vec3 to =
            from + random.uniform(0, 1) *
                       Vec3{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
        World world;
        world.add(Model(room), {});
        world.add(Capsule{{from, to}, radius}, {});
        for (const ContactManifold& m : world.contact_manifolds(0.05)) {
            const Vec3 n = m.normal;
            const double most = std::max({n.x, n.y, n.z});
            ASSERT_GT(most, 1 - 1e-12) << "round " << round;
            const double nearest = std::min(dot(n, from), dot(n, to));
            EXPECT_NEAR(m.points[0].depth, radius - nearest, 1e-9) << "round " << round;
            for (std::uint32_t k = 0; k < m.count; ++k)
                EXPECT_NEAR(dot(n, m.points[k].point_a), 0, 1e-9) << "round " << round;
            ++walls;
        }
    }
    EXPECT_GT(walls, many(300));
}

TEST(RoundedWalls, AFloorOfManyTrianglesIsOneWall) {
    Random random(20261403);
    int found_any = 0;
    for (int round = 0; round < many(300); ++round) {
        // Positions of a mesh are single precision: a turned floor is bent by rounding.
        const Transform turned = random.pose(0);
        const auto turn = [&](const Vec3& p) { return apply_linear(turned, p); };
        const Mesh floor = grid_mesh(12, 12, false, false, [&](double u, double v) {
            return turn({4 * u - 2, 4 * v - 2, 0});
        });
        const double radius = random.uniform(0.1, 0.6);
        const Vec3 normal = turn({0, 0, 1});
        const Vec3 foot = turn({random.uniform(-1, 1), random.uniform(-1, 1), 0});
        const Vec3 centre = foot + radius * random.uniform(0.4, 1.01) * normal;
        const bool first = random.chance(0.5);
        const Vec3 axis = random.chance(0.5) ? turn({random.uniform(-0.3, 0.3), 0.2, 0})
                                             : 0.3 * random.direction();
        for (const bool is_capsule : {false, true}) {
            const auto found =
                is_capsule
                    ? walls_of(floor, Capsule{{{}, dot(axis, normal) < 0 ? -axis : axis}, radius},
                               centre, {}, first, 0.02)
                    : walls_of(floor, Sphere{{}, radius}, centre, {}, first, 0.02);
            ASSERT_EQ(found.size(), 1U) << "round " << round;
            EXPECT_LE(length((first ? -1 : 1) * found[0].normal - normal), 1e-5);
            ++found_any;
        }
    }
    EXPECT_GT(found_any, many(300));
}

TEST(RoundedWalls, WhatEachWallHoldsLiesBeyondTheBody) {
    // After moving by depth along each normal, no place of the surface is left in the ball: every place
    // near it lies below the plane of some wall, give or take what rises too little to be a wall.
    Random random(20261404);
    std::cout << "seed 20261404\n";
    int several = 0;
    for (int round = 0; round < many(400); ++round) {
        const double height = random.uniform(0.02, 0.3), waves = random.uniform(2, 15);
        const Mesh ground = grid_mesh(16, 16, false, false, [=](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, height * std::cos(waves * u) * std::cos(waves * v)};
        });
        const double radius = random.uniform(0.1, 0.4);
        Vec3 centre{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 2};
        World world;
        world.add(Model(ground), {});
        const BodyId ball = world.add(Sphere{{}, radius}, {centre});
        const auto gaps = world.within(4);
        ASSERT_EQ(gaps.size(), 1U);
        centre.z -= gaps[0].distance; // nearer, by at most the gap
        world.move(ball, {centre});
        const auto nearer = world.within(4);
        ASSERT_EQ(nearer.size(), 1U);
        centre = centre - (nearer[0].distance + random.uniform(-0.01, 0.03)) * nearer[0].normal;
        world.move(ball, {centre});
        const double margin = 0.02;
        const auto walls = world.contact_manifolds(margin);
        several += walls.size() > 1 ? 1 : 0;
        for (const ContactManifold& m : walls) {
            const ContactPoint& p = m.points[0];
            EXPECT_NEAR(length(centre - p.point_a), radius - p.depth, 1e-9);
            EXPECT_LE(length(centre - (radius - p.depth) * m.normal - p.point_a), 1e-9);
        }
        if (walls.size() == 4)
            continue; // others may be left out
        for (const auto& t : ground.triangles) {
            const Vec3 p = ground.positions[t[0]];
            if (length(centre - p) > radius + margin)
                continue;
            const bool is_below =
                std::any_of(walls.begin(), walls.end(), [&](const ContactManifold& m) {
                    return dot(p - m.points[0].point_a, m.normal) <= 0x1p-9 * radius;
                });
            EXPECT_TRUE(is_below) << "round " << round;
        }
    }
    std::cout << several << " with several walls\n";
    EXPECT_GT(several, many(400) / 40);
}

TEST(RoundedWalls, AWallKeepsItsNumberWhileABallRollsAlongAValley) {
    const double angle = 40 * kDegreeOfAngle, radius = 0.3;
    World world;
    const Mesh mesh = valley_of(angle, 10);
    world.add(Model(mesh), {});
    const BodyId ball = world.add(Sphere{{}, radius}, {});
    Random random(20261405);
    std::vector<double> side(2);
    for (int step = 0; step < 400; ++step) {
        world.move(ball, {{1e-3 * random.uniform(-1, 1), -1 + 0.005 * step,
                           (radius - 0.002) / std::cos(angle)}});
        const auto found = world.contact_manifolds(0.02);
        ASSERT_EQ(found.size(), 2U) << "step " << step;
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(found[k].region, k);
            if (step == 0)
                side[k] = found[k].normal.x;
            EXPECT_GT(side[k] * found[k].normal.x, 0) << "step " << step;
        }
    }
}

} // namespace
} // namespace abut::test
