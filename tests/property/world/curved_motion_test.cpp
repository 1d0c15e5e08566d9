// Times of impact and the schedule of cylinders, cones, ellipsoids and half-spaces, against small
// steps of the same motions.

#include <abut/deformable.h>
#include <abut/world.h>

#include "tests/support/curved_shapes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/world_motions.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

namespace abut::test {
namespace {

/// The first of some small steps at which two bodies share a point; nothing if none does.
std::optional<double> first_contact(World& world, const std::vector<BodyMotion>& motions,
                                    int steps) {
    for (int step = 0; step <= steps; ++step) {
        const double t = double(step) / steps;
        move_to(world, motions, {}, t);
        if (!world.collide().empty())
            return t;
    }
    return std::nullopt;
}

BodyId add_any(Random& random, World& world, int kind, const Pose& pose) {
    switch (kind) {
    case 0:
        return world.add(Model(tetrahedron(0.7)), pose);
    case 1:
        return world.add(Convex(tetrahedron(0.7).positions), pose);
    case 2:
        return world.add(Sphere{random.in_cube(0.2), random.uniform(0, 0.4)}, pose);
    case 3:
        return world.add(Box3{{-0.3, -0.2, -0.1}, {0.2, 0.3, 0.4}}, pose);
    case 4:
        return world.add(HalfSpace{random.direction(), -1}, {{}, pose.rotation});
    default:
        return add(world, curved_shape(random, random.integer(0, 2)), pose);
    }
}

TEST(CurvedMotion, ImpactsAreNoLaterThanFineSteps) {
    Random random(7201);
    constexpr int kSteps = 60;
    int hits = 0, misses = 0, tight = 0, proven = 0;
    for (int round = 0; round < many(400); ++round) {
        SCOPED_TRACE(round);
        World world;
        const Pose pose_a = random.pose(1), pose_b = random.pose(1);
        const BodyId a = add(world, curved_shape(random, round % 3), pose_a);
        const BodyId b = add_any(random, world, random.integer(0, 7), pose_b);
        std::vector<BodyMotion> motions;
        for (const BodyId id : {a, b})
            if (id == a || random.chance(0.7))
                motions.push_back(
                    {id,
                     {id == a ? pose_a
                              : Pose{{world.world_from_body(b).m[9], world.world_from_body(b).m[10],
                                      world.world_from_body(b).m[11]},
                                     pose_b.rotation},
                      random.in_cube(1), random.in_cube(2),
                      random.chance(0.3) ? Vec3{} : random.in_cube(2)}});
        const auto impacts = world.time_of_impact(motions);
        const auto contact = first_contact(world, motions, kSteps);
        if (!contact) {
            misses += impacts.empty() ? 1 : 0;
            continue;
        }
        ++hits;
        ASSERT_EQ(impacts.size(), 1U);
        const Impact& impact = impacts[0].impact;
        EXPECT_LE(impact.time, *contact + 1e-9);
        tight += impact.time > *contact - 1.5 / kSteps ? 1 : 0;
        proven += impact.status == Status::exact ? 1 : 0;
        if (impact.time > 0) {
            EXPECT_NEAR(length(impact.point_b - impact.point_a), impact.gap, 1e-6);
        }
    }
    EXPECT_GT(hits, many(400) / 8);
    EXPECT_GT(misses, many(400) / 8);
    EXPECT_GT(tight, hits * 8 / 10);
    EXPECT_GT(proven, hits * 7 / 10);
}

TEST(CurvedMotion, DeformablesMeetCurvedShapesAndHalfSpacesNoLater) {
    Random random(7202);
    constexpr int kSteps = 40;
    int hits = 0, misses = 0, tight = 0;
    for (int round = 0; round < many(200); ++round) {
        SCOPED_TRACE(round);
        const Mesh mesh = transformed(grid_mesh(3, 3, false, false,
                                                [](double u, double v) {
                                                    return Vec3{u, v, 0};
                                                }),
                                      random.pose(0.8));
        MovingSurface moving(mesh);
        std::vector<Vec3> end = mesh.positions;
        const Vec3 way = random.in_cube(1.5);
        for (Vec3& p : end)
            p = p + way + random.in_cube(0.2);
        moving.set_step(mesh.positions, end);
        World world;
        const BodyId cloth = world.add(moving.surface);
        const Pose pose = random.pose(1);
        const BodyId body = add_any(random, world, 4 + round % 3, pose);
        const Transform at_start = world.world_from_body(body);
        const std::vector<BodyMotion> motions{
            {body,
             {{{at_start.m[9], at_start.m[10], at_start.m[11]}, pose.rotation},
              random.in_cube(1),
              random.in_cube(1),
              random.chance(0.5) ? Vec3{} : random.in_cube(1)}}};
        const auto impacts = world.time_of_impact(motions);
        const std::vector<Surface> surfaces{{cloth, moving}};
        std::optional<double> contact;
        for (int step = 0; step <= kSteps && !contact; ++step) {
            move_to(world, motions, surfaces, double(step) / kSteps);
            if (!world.collide().empty())
                contact = double(step) / kSteps;
        }
        if (!contact) {
            misses += impacts.empty() ? 1 : 0;
            continue;
        }
        ++hits;
        ASSERT_EQ(impacts.size(), 1U);
        EXPECT_LE(impacts[0].impact.time, *contact + 1e-9);
        tight += impacts[0].impact.time > *contact - 2.0 / kSteps ? 1 : 0;
    }
    EXPECT_GT(hits, many(200) / 8);
    EXPECT_GT(misses, many(200) / 8);
    EXPECT_GT(tight, hits * 7 / 10);
}

/// Two large bodies far from the origin slide along each other at a tiny gap and turn. Rounding then
/// tilts the direction between their closest points, along which they would not meet for long.
/// A triangle of size 5e-4 between a cylinder of radius 1 and the prism around it, near an edge of the
/// prism.
Mesh speck_beside_a_cylinder() {
    return {{{1.002, 0, 0}, {1.002, 2e-4, 2e-4}, {1.0023, 0, 4e-4}}, {{0, 1, 2}}};
}

TEST(CurvedMotion, ASurfaceThatStartsInThePolyhedronIsNotMissed) {
    const Cylinder cylinder{{{0, 0, -1}, {0, 0, 1}}, 1};
    const Mesh speck = speck_beside_a_cylinder();
    Deformable surface(speck);
    std::vector<Vec3> end = speck.positions;
    for (Vec3& p : end)
        p.x -= 0.5;
    surface.advance(end);
    World world;
    world.add(cylinder, {}, {.is_static = true});
    world.add(surface);
    const auto impacts = world.time_of_impact({});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_LE(impacts[0].impact.time, 0.004);

    // The schedule measures the shape itself.
    World other;
    other.add(cylinder, {}, {.is_static = true});
    const BodyId rigid = other.add(Model(speck), {});
    other.set_speed(rigid, {.velocity = {-0.5, 0, 0}});
    other.advance(0);
    EXPECT_LE(other.next_event(), 0.004);
    EXPECT_GT(other.next_event(), 0);
}

TEST(CurvedMotion, VerticesOfNoTriangleMeetNothing) {
    Deformable surface(Mesh{{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, 1}}, {{0, 1, 2}}});
    surface.advance(std::vector<Vec3>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, -1}});
    World world;
    world.add(HalfSpace{{0, 0, 1}, 0}, {}, {.is_static = true});
    world.add(surface);
    EXPECT_TRUE(world.time_of_impact({}).empty());
}

TEST(CurvedMotion, TheToleranceIsThatOfTheBodyFarFromTheFloorsOrigin) {
    World world;
    world.add(HalfSpace{{0, 0, 1}, 0}, {}, {.is_static = true});
    const BodyId ball = world.add(Sphere{{}, 1}, {{1e6, 0, 3}});
    const auto impacts =
        world.time_of_impact({{ball, Motion::between({{1e6, 0, 3}}, {{1e6, 0, -1}})}});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_LE(impacts[0].impact.time, 0.5);
    EXPECT_GT(impacts[0].impact.time, 0.5 - 1e-5);
}

TEST(CurvedMotion, FarBodiesThatSlideAreNotLate) {
    Random random(7203);
    int hits = 0;
    for (int round = 0; round < many(60); ++round) {
        SCOPED_TRACE(round);
        World world;
        const Vec3 far = 1e6 * random.direction();
        const double size = random.uniform(50, 200), gap = std::pow(10, random.uniform(-7, -4));
        const auto add_slab = [&](double z) {
            const Vec3 half{size, size, 1};
            const Pose pose{far + Vec3{0, 0, z}, {1, 0, 0, 0}};
            const BodyId id = round % 2 == 0
                                  ? world.add(Cylinder{{{0, 0, -1}, {0, 0, 1}}, size}, pose)
                                  : world.add(Convex(box_mesh(-half, half).positions), pose);
            return std::pair(id, pose);
        };
        const auto [a, pose_a] = add_slab(-1);
        const auto [b, pose_b] = add_slab(1 + gap);
        const Vec3 slide = random.uniform(0, 10) * Vec3{random.direction().x, 1, 0};
        const double tilt = random.uniform(0.1, 3) * gap / size;
        std::vector<BodyMotion> motions{
            {a, {pose_a, pose_a.translation, -slide, {tilt, 0, random.uniform(-1, 1)}}},
            {b, {pose_b, pose_b.translation, slide, {0, tilt, random.uniform(-1, 1)}}}};
        const auto impacts = world.time_of_impact(motions);
        const auto contact = first_contact(world, motions, 200);
        if (!contact)
            continue;
        ++hits;
        ASSERT_EQ(impacts.size(), 1U);
        EXPECT_LE(impacts[0].impact.time, *contact + 1e-9);
    }
    EXPECT_GT(hits, many(60) / 5);
}

TEST(CurvedMotion, TheScheduleReportsWhatCollideFinds) {
    Random random(7204);
    std::size_t met = 0, apart = 0, saved = 0;
    for (int round = 0; round < many(12); ++round) {
        World world;
        struct Flight {
            BodyId id;
            Pose start;
            SpeedBounds bounds;
        };
        std::vector<Flight> flights;
        const BodyId floor = world.add(HalfSpace{random.direction(), -1.5}, {});
        for (int i = 0; i < 12; ++i) {
            const Pose pose = random.pose(2);
            const BodyId id =
                add_any(random, world, random.chance(0.6) ? 5 : random.integer(0, 3), pose);
            flights.push_back({id,
                               pose,
                               {.velocity = random.in_cube(0.5),
                                .acceleration = {0, 0, -0.3},
                                .angular_velocity = random.in_cube(1)}});
            world.set_speed(id, flights.back().bounds);
        }
        if (round % 3 == 1) // a floor that sinks
            flights.push_back({floor, {}, {.velocity = random.in_cube(0.2)}});
        if (round % 3 == 2) // and one that turns
            flights.push_back({floor, {}, {.angular_velocity = random.in_cube(0.1)}});
        if (round % 3 != 0)
            world.set_speed(floor, flights.back().bounds);
        constexpr double kStep = 0.02;
        double quiet = -1; // nothing begins to touch before
        BodyPairs last;
        for (int step = 0; step < 60; ++step) {
            const double now = step * kStep;
            for (const Flight& each : flights) {
                const SpeedBounds& bounds = each.bounds;
                const Motion motion{each.start, each.start.translation, bounds.velocity,
                                    bounds.angular_velocity};
                Pose pose = pose_at(motion, now);
                pose.translation = pose.translation + (0.5 * now * now) * bounds.acceleration;
                world.move(each.id, pose);
            }
            const BodyPairs touching = world.advance(step == 0 ? 0 : kStep);
            const BodyPairs expected = world.collide();
            ASSERT_EQ(touching, expected) << "round " << round << ", step " << step;
            if (step > 0 && now < quiet) {
                EXPECT_TRUE(without(touching, last).empty());
            }
            last = touching;
            met += touching.size(), apart += world.pairs().size() - touching.size();
            quiet = now + world.next_event() * (1 - 1e-9);
            saved += quiet > now + kStep ? 1 : 0;
        }
    }
    EXPECT_GT(met, 200U);
    EXPECT_GT(apart, 200U);
    EXPECT_GT(saved, std::size_t(many(12) * 5));
}

TEST(CurvedMotion, ABallFallsOnAFloorWhenItShould) {
    World world;
    const BodyId floor = world.add(HalfSpace{{0, 0, 1}, 0}, {}, {.is_static = true});
    const BodyId ball = world.add(Sphere{{}, 0.5}, {{0, 0, 10}, {1, 0, 0, 0}});
    world.set_speed(ball, {.acceleration = {0, 0, -10}});
    EXPECT_TRUE(world.advance(0).empty());
    const double expected = std::sqrt(2 * 9.5 / 10);
    EXPECT_NEAR(world.time_to_collision(floor, ball), expected, 1e-6);
    EXPECT_NEAR(world.time_to_collision(), expected, 1e-6);
    world.set_speed(ball, {.velocity = {1, 0, 0}});       // along the floor
    EXPECT_GT(world.time_to_collision(floor, ball), 1e9); // it never falls, but for rounding
    const auto impacts =
        world.time_of_impact({{ball, {{{0, 0, 10}, {1, 0, 0, 0}}, {0, 0, 10}, {3, 0, -19}, {}}}});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_NEAR(impacts[0].impact.time, 0.5, 1e-6);
    EXPECT_NEAR(impacts[0].impact.normal.z, 1, 1e-12); // from the floor to the ball
    EXPECT_EQ(impacts[0].impact.status, Status::exact);
}

} // namespace
} // namespace abut::test
