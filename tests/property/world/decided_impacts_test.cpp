// Impacts that a search must decide: large bodies that turn beside small ones, surfaces that go into a solid
// at one instant, and small bodies over huge grounds. Fine steps of the same motions, and closed forms, tell
// the truth.

#include <abut/deformable.h>
#include <abut/world.h>

#include "convex/support/support_gap.h"
#include "math/transform.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/world_motions.h"
#include "world/narrow_phase/solid_gap.h"
#include "world/schedule/turning_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace abut::test {
namespace {

struct Flight {
    World world;
    BodyId still, moving;
    Motion motion;

    Flight(const AnyShape& a, const AnyShape& b, const Motion& m) : motion(m) {
        still = add(world, a, {});
        moving = add(world, b, m.start);
    }
    std::vector<BodyImpact> impacts() { return world.time_of_impact({{moving, motion}}); }
    /// The signed distance at a time; infinite beyond a reach.
    double distance_at(double time, double reach) {
        world.move(moving, pose_at(motion, time));
        const auto gaps = world.within(reach);
        return gaps.empty() ? std::numeric_limits<double>::infinity() : gaps[0].distance;
    }
};

AnyShape shape_of_size(Random& random, int kind, double size) {
    const auto some = [&] { return 0.25 * size * random.integer(1, 4); };
    const double a = some(), b = some(), c = some();
    switch (kind) {
    case 0:
        return Box3{{-a, -b, -c}, {a, b, c}};
    case 1:
        return Convex(box_mesh({-a, -b, -c}, {a, b, c}).positions);
    case 2:
        return Model(box_mesh({-a, -b, -c}, {a, b, c}));
    case 3:
        return Cylinder{{{0, 0, -a}, {0, 0, a}}, b};
    case 4:
        return Cone{{0, 0, a}, {0, 0, -a}, b};
    case 5:
        return Ellipsoid{{}, {a, b, c}};
    default:
        return Capsule{{{0, 0, -a}, {0, 0, a}}, b};
    }
}
constexpr int kSizedKinds = 7;

Vec3 some_axis(Random& random) {
    static const std::array<Vec3, 6> kAxes{Vec3{1, 0, 0}, {0, 1, 0},  {0, 0, 1},
                                           {-1, 0, 0},    {0, -1, 0}, {0, 0, -1}};
    return kAxes[static_cast<std::size_t>(random.integer(0, 5))];
}
Vec3 on_eighths(Random& random, double size) {
    return (size / 8) * (random.on_lattice(16) - Vec3{8, 8, 8});
}

/// A motion beside or into a body of size 1 at the origin, of a body of another size.
Motion motion_beside(Random& random, double size) {
    const double both = 1 + size;
    Motion motion;
    switch (random.integer(0, 3)) {
    case 0: // flies into it
        motion.start.translation = Vec3{2 * both, 0, 0} + on_eighths(random, 1);
        motion.velocity = {-3 * both, 0, 0};
        break;
    case 1: // turns over it
        motion.start.translation = Vec3{0, 0, both} + on_eighths(random, 1);
        break;
    case 2: // slides over it
        motion.start.translation = Vec3{-2 * both, 0, both} + on_eighths(random, 0.5);
        motion.velocity = {4 * both, 0, 0};
        break;
    default: // swings about a place in it
        motion.start.translation = Vec3{1.5 * both, 0, 0} + on_eighths(random, 1);
        break;
    }
    motion.centre = motion.start.translation;
    if (random.chance(0.3))
        motion.centre = on_eighths(random, 0.5);
    motion.angular_velocity =
        random.chance(0.5) ? 1.0 * random.integer(-6, 6) * some_axis(random) : random.in_cube(4);
    return motion;
}

TEST(DecidedImpacts, BodiesOfUnlikeSizesThatTurn) {
    Random random(5501);
    int hits = 0, misses = 0, undecided = 0;
    for (int round = 0; round < many(350); ++round) {
        const double size = random.chance(0.5) ? 1 : std::pow(10, random.integer(-3, 3));
        const int still = random.integer(0, kSizedKinds - 1),
                  moving = random.integer(0, kSizedKinds - 1);
        SCOPED_TRACE("round " + std::to_string(round) + " of " + std::to_string(still) + " and " +
                     std::to_string(moving) + " of size " + std::to_string(size));
        Flight flight(shape_of_size(random, still, 1), shape_of_size(random, moving, size),
                      motion_beside(random, size));
        const auto impacts = flight.impacts();
        const double until = impacts.empty() ? 1 : impacts[0].impact.time,
                     small = std::min(size, 1.0);
        // Nothing is met before the time that is told.
        constexpr int kSteps = 60;
        const bool at_start = flight.distance_at(0, 1e-3 * small) <= 1e-9;
        for (int step = 1; step < kSteps && !at_start; ++step)
            ASSERT_GT(flight.distance_at(until * step / kSteps, 1e-3 * small), -1e-9 * (1 + size));
        if (impacts.empty()) {
            ++misses;
            continue;
        }
        ++hits;
        const Impact& impact = impacts[0].impact;
        if (impact.contact_time <= 1) {
            EXPECT_NE(impact.status, Status::bound_only);
            EXPECT_LE(flight.distance_at(impact.contact_time, 1), 1e-9 * (1 + size));
        } else { // they graze: however near they come, they do not overlap
            ++undecided;
            EXPECT_LE(impact.gap, 1e-6 * (1 + size));
            for (int step = 0; step <= 4 * kSteps; ++step)
                EXPECT_GT(
                    flight.distance_at(until + (1 - until) * std::pow(0.5, 0.1 * step), small),
                    -1e-6 * small);
        }
    }
    EXPECT_GT(hits, many(350) / 6);
    EXPECT_GT(misses, many(350) / 10);
    EXPECT_LT(undecided, many(350) / 50);
}

TEST(DecidedImpacts, ALargeBodyThatSpinsOverASmallOneDoesNotMeetIt) {
    const AnyShape box = Box3{{-.5, -.5, -.5}, {.5, .5, .5}};
    const Mesh mesh = box_mesh({-.5, -.5, -.5}, {.5, .5, .5});
    for (const AnyShape& small : {box, AnyShape(Convex(mesh.positions)), AnyShape(Model(mesh))})
        for (const AnyShape& large :
             {AnyShape(Cylinder{{{0, 0, -1}, {0, 0, 1}}, 1000}),
              AnyShape(Cone{{0, 0, 1}, {0, 0, -1}, 1000}), AnyShape(Ellipsoid{{}, {1000, 900, 1}}),
              AnyShape(Box3{{-1000, -900, -1}, {1000, 900, 1}})})
            for (const double gap : {0.25, 1e-3}) {
                Motion motion;
                motion.start.translation = motion.centre = {3, -2, 1.5 + gap};
                motion.angular_velocity = {0, 0, 6};
                SCOPED_TRACE(std::to_string(small.index()) + " under " +
                             std::to_string(large.index()));
                EXPECT_TRUE(Flight(small, large, motion).impacts().empty());
                // It comes down while it spins.
                motion.velocity = {0, 0, -2 * gap};
                const auto impacts = Flight(small, large, motion).impacts();
                ASSERT_EQ(impacts.size(), 1U);
                const Impact& impact = impacts[0].impact;
                EXPECT_NE(impact.status, Status::bound_only);
                EXPECT_LE(impact.time, impact.contact_time);
                EXPECT_LT(impact.steps, 400U);
                if (!std::holds_alternative<Ellipsoid>(large)) {
                    EXPECT_LE(impact.time, 0.5);
                    EXPECT_NEAR(impact.contact_time, 0.5, 1e-3);
                }
            }
}

TEST(DecidedImpacts, APlateOfTrianglesThatSpinsOverACurvedBodyDoesNotMeetIt) {
    for (const double size : {10.0, 100.0, 1000.0})
        for (const AnyShape& small : {AnyShape(Cone{{0, 0, 0}, {0, 0, -1}, .5}),
                                      AnyShape(Cone{{.6, 0, 0}, {-.1, 0, -1}, .5}),
                                      AnyShape(Cylinder{{{0, 0, -1}, {}}, .5}),
                                      AnyShape(Ellipsoid{{0, 0, -.5}, {.7, .6, .5}})})
            for (const double beside : {0.0, 0.1, 0.25, 3.0}) { // the axis about which it spins
                SCOPED_TRACE(std::to_string(small.index()) + " under " + std::to_string(size));
                Motion motion;
                motion.start.translation = motion.centre = {beside, 0, 1e-3};
                motion.angular_velocity = {0, 0, 5};
                motion.centre.x = 0;
                const Model plate(box_mesh({-size, -size, 0}, {size, size, 0.1 * size}));
                EXPECT_TRUE(Flight(small, plate, motion).impacts().empty());
                motion.velocity = {0, 0, -2e-3};
                const auto impacts = Flight(small, plate, motion).impacts();
                ASSERT_EQ(impacts.size(), 1U);
                EXPECT_NE(impacts[0].impact.status, Status::bound_only);
                EXPECT_NEAR(impacts[0].impact.time, 0.5, 1e-2);
                EXPECT_LT(impacts[0].impact.steps, 400U);
            }
}

TEST(DecidedImpacts, AHalfSpaceThatTurnsIsMetOnlyWhereItIs) {
    const Vec3 half{.5, .5, .5};
    for (const AnyShape& body :
         {AnyShape(Sphere{{}, .5}), AnyShape(Box3{-half, half}),
          AnyShape(Model(box_mesh(-half, half))), AnyShape(Cone{{0, 0, .5}, {0, 0, -.5}, .5})})
        for (const double far : {1.0, 1e2, 1e4, 1e6})
            for (const Vec3& turn : {Vec3{0, 0, 1}, Vec3{.1, 0, 0}, Vec3{0, .5, 0}}) {
                SCOPED_TRACE(std::to_string(body.index()) + " about " + std::to_string(far));
                World world;
                const BodyId plane = world.add(HalfSpace{{0, 0, 1}, 0}, {});
                Motion of_plane, of_body;
                of_plane.angular_velocity = turn;
                // Moves by 1 along a circle at the height 3.
                of_body.start.translation = {1, 0, 3};
                of_body.centre = {1, far, 3};
                of_body.angular_velocity = {0, 0, 1 / far};
                const BodyId id = add(world, body, of_body.start);
                EXPECT_TRUE(world.time_of_impact({{plane, of_plane}, {id, of_body}}).empty());
            }
}

TEST(DecidedImpacts, ASheetThatFallsFlatIntoASolidMeetsIt) {
    const Mesh sheet{{{-.1, -.1, 0}, {.1, -.1, 0}, {.1, .1, 0}, {-.1, .1, 0}},
                     {{0, 1, 2}, {0, 2, 3}}};
    const Vec3 half{1, 1, 1};
    for (const AnyShape& solid :
         {AnyShape(Box3{-half, half}), AnyShape(Convex(box_mesh(-half, half).positions))})
        for (const double turn : {0.0, 2.0}) {
            Motion motion;
            motion.start.translation = motion.centre = {0.25, -0.125, 3};
            motion.velocity = {0, 0, -3.1};
            motion.angular_velocity = {0, 0, turn};
            const auto impacts = Flight(solid, Model(sheet), motion).impacts();
            ASSERT_EQ(impacts.size(), 1U);
            const Impact& impact = impacts[0].impact;
            EXPECT_EQ(impact.status, Status::exact) << solid.index();
            EXPECT_NEAR(impact.time, 2 / 3.1, 1e-6);
            EXPECT_NEAR(impact.contact_time, 2 / 3.1, 1e-6);
        }
}

TEST(DecidedImpacts, TheToleranceIsThatOfTheSmallBodyWhateverItTurnsAbout) {
    constexpr double kGround = 5e6;
    const Vec3 low{-kGround, -kGround, -1}, high{kGround, kGround, 0};
    const Mesh slab = box_mesh(low, high);
    const std::vector<AnyShape> grounds{Box3{low, high},
                                        Box3{{-kGround, -kGround, -2 * kGround}, high},
                                        Convex(slab.positions),
                                        Model(slab),
                                        HalfSpace{{0, 0, 1}, 0},
                                        Cylinder{{{0, 0, -1}, {}}, kGround},
                                        Cone{{0, 0, -1}, {}, kGround},
                                        Ellipsoid{{0, 0, -kGround}, {kGround, kGround, kGround}}};
    const Vec3 half{.5, .5, .5};
    const std::vector<AnyShape> bodies{
        Sphere{{}, .5}, Box3{-half, half}, Convex(box_mesh(-half, half).positions),
        Model(box_mesh(-half, half)), Cylinder{{{0, 0, -.5}, {0, 0, .5}}, .5}};
    for (const AnyShape& ground : grounds)
        for (const AnyShape& body : bodies)
            for (const double lever : {0.0, 3e6}) { // to the centre of the body's motion
                SCOPED_TRACE(std::to_string(body.index()) + " on " +
                             std::to_string(ground.index()));
                Motion motion;
                motion.start.translation = {0, 0, 8};
                motion.centre = {lever, 0, 8};
                motion.velocity = {0, 0, -10};
                const auto impacts = Flight(ground, body, motion).impacts();
                ASSERT_EQ(impacts.size(), 1U);
                const Impact& impact = impacts[0].impact;
                EXPECT_LE(impact.time, 0.75);
                EXPECT_GE(impact.time, 0.75 - 3e-5); // coordinates of 5e6 round by 1e-9
                EXPECT_GE(impact.contact_time, 0.75 - 1e-9);
                EXPECT_LE(impact.contact_time, 0.75 + 3e-5);
            }
}

TEST(DecidedImpacts, TheToleranceOfAClothIsNotThatOfItsPath) {
    Mesh cloth{{{0, 0, 9000}, {1, 0, 9000}, {1, 1, 9000}, {0, 1, 9000}}, {{0, 1, 2}, {0, 2, 3}}};
    for (const AnyShape& ground :
         {AnyShape(HalfSpace{{0, 0, 1}, 0}), AnyShape(Box3{{-1e4, -1e4, -1}, {1e4, 1e4, 0}})}) {
        Deformable surface(cloth);
        std::vector<Vec3> end = cloth.positions;
        for (Vec3& p : end)
            p.z = -1000;
        surface.advance(end);
        World world;
        world.add(surface);
        add(world, ground, {});
        const auto impacts = world.time_of_impact({});
        ASSERT_EQ(impacts.size(), 1U);
        EXPECT_LE(impacts[0].impact.time, 0.9);
        EXPECT_LE(impacts[0].impact.gap, 2e-6) << ground.index();
    }
}

TEST(DecidedImpacts, RoomAlongADirectionIsNeverLessThanItsBound) {
    Random random(5502);
    int useful = 0, seen = 0;
    for (int round = 0; round < many(400); ++round) {
        const AnyShape shape_a = shape_of_size(random, 3 + random.integer(0, 2), 1),
                       shape_b = shape_of_size(random, 3 + random.integer(0, 2), 1);
        Motion motion_a, motion_b;
        motion_a.start = random.pose(0), motion_b.start = random.pose(0);
        const Vec3 n = random.direction();
        motion_b.start.translation = random.uniform(2, 4) * n;
        motion_a.centre = random.in_cube(0.5);
        motion_b.centre = motion_b.start.translation + random.in_cube(0.5);
        for (Motion* each : {&motion_a, &motion_b}) {
            each->velocity = random.in_cube(1);
            each->angular_velocity =
                random.chance(0.3) ? random.uniform(-3, 3) * n : random.in_cube(3);
        }
        const auto solid = [](const AnyShape& shape, const Motion& motion, double time) {
            const BodyShape body = std::visit(
                [](const auto& each) -> BodyShape {
                    if constexpr (requires { shape_of(each); })
                        return shape_of(each);
                    return shape_of(Sphere{});
                },
                shape);
            return *support_of(PlacedBody{body, at(motion, time)});
        };
        const SupportShape a = solid(shape_a, motion_a, 0), b = solid(shape_b, motion_b, 0);
        const auto turning = [](const SupportShape& s, const Motion& m) {
            return TurningSolid{s, m.centre, m.velocity, m.angular_velocity,
                                s.reach + length(s.centre - m.centre)};
        };
        const TurningSolid turning_a = turning(a, motion_a), turning_b = turning(b, motion_b);
        const double now = least_room_after(0, turning_a, turning_b, n);
        EXPECT_NEAR(now, separation_along(a, b, n), 1e-12);
        const auto room_at = [&](double time) {
            return separation_along(solid(shape_a, motion_a, time), solid(shape_b, motion_b, time),
                                    n);
        };
        const double then = random.uniform(0, 1),
                     bound = least_room_after(then, turning_a, turning_b, n);
        for (const double part : {0.25, 0.5, 0.75, 1.0})
            EXPECT_GE(room_at(part * then), (1 - part) * now + part * bound - 1e-12);
        const double margin = random.uniform(0, 0.5),
                     proven = time_with_room(turning_a, turning_b, n, margin, 1);
        for (const double part : {0.3, 0.6, 0.9, 1.0})
            if (proven > 0) {
                EXPECT_GE(room_at(part * proven), margin - 1e-12);
            }
        // Along a vector that turns with one of them.
        const auto check_beside = [&](const TurningSolid& from, const TurningSolid& other,
                                      const Motion& motion, const Vec3& way) {
            const double found = time_with_room_beside(from, other, way, margin, 1);
            seen += found > 0.05 ? 1 : 0;
            for (const double part : {0.3, 0.6, 0.9, 1.0}) {
                const Transform from_start =
                    compose(at(motion, part * found), inverse(at(motion, 0)));
                const Vec3 turned = apply_linear(from_start, n);
                const double room =
                    separation_along(solid(shape_a, motion_a, part * found),
                                     solid(shape_b, motion_b, part * found), turned);
                if (found > 0) {
                    EXPECT_GE(room, margin - 1e-12);
                }
            }
        };
        check_beside(turning_a, turning_b, motion_a, n);
        check_beside(turning_b, turning_a, motion_b, -n);
        useful += proven > 0.05 ? 1 : 0;
    }
    EXPECT_GT(useful, many(400) / 4);
    EXPECT_GT(seen, many(400) / 4);
}

} // namespace
} // namespace abut::test
