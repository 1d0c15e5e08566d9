// Times of impact worked by hand, motions, and invalid arguments.

#include <abut/error.h>
#include <abut/motion.h>

#include "tests/support/infinity.h"
#include "tests/support/shapes.h"
#include "tests/unit/rigid/unit_box.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kPi = std::numbers::pi;
const Model kPlate(Mesh{{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}});

Pose at_point(double x, double y, double z) {
    return {{x, y, z}, {1, 0, 0, 0}};
}
Pose turned(double angle, const Vec3& axis, const Vec3& to = {}) {
    const double s = std::sin(angle / 2);
    return {to, {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z}};
}
Motion straight(const Vec3& from, const Vec3& to) {
    return Motion::between(at_point(from.x, from.y, from.z), at_point(to.x, to.y, to.z));
}
Motion spin(const Vec3& w) {
    return {{}, {}, {}, w};
}

/// Expects an impact that is not late, has contact at the reported time, and is within the
/// tolerance.
void expect_hit(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b,
                double expected, double slack = 1e-5) {
    const Impact impact = time_of_impact(a, motion_a, b, motion_b);
    ASSERT_TRUE(impact.meet);
    EXPECT_EQ(impact.status, Status::exact);
    EXPECT_LE(impact.time, expected);
    EXPECT_NEAR(impact.time, expected, slack);
    EXPECT_GE(impact.contact_time, expected - 1e-15);
    EXPECT_NEAR(impact.contact_time, expected, slack);
    const Transform world_a = at(motion_a, impact.contact_time),
                    world_b = at(motion_b, impact.contact_time);
    EXPECT_TRUE(collide(a, world_a, b, world_b).meet());
    const Gap gap = distance(a, at(motion_a, impact.time), b, at(motion_b, impact.time));
    EXPECT_NEAR(gap.distance, impact.gap, 1e-14);
}

void expect_miss(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b) {
    const Impact impact = time_of_impact(a, motion_a, b, motion_b);
    EXPECT_FALSE(impact.meet);
    EXPECT_EQ(impact.time, 1);
    EXPECT_EQ(impact.contact_time, kInfinity);
    EXPECT_EQ(impact.status, Status::exact);
}

TEST(TimeOfImpact, BoxesApproach) {
    // A gap of 2 closes at speed 4. Then the other box moves too.
    expect_hit(kBox, Motion::fixed({}), kBox, straight({3, 0, 0}, {-1, 0, 0}), 0.5);
    expect_hit(kBox, straight({0, 0, 0}, {2, 0, 0}), kBox, straight({3, 0.5, 0.25}, {1, 0.5, 0.25}),
               0.5);
    const Impact impact =
        time_of_impact(kBox, Motion::fixed({}), kBox, straight({3, 0.5, 0.25}, {-1, 0.5, 0.25}));
    EXPECT_NEAR(impact.normal.x, 1, 1e-12);
    EXPECT_NEAR(impact.point_a.x, 1, 1e-12);
    EXPECT_NEAR(impact.point_b.x, 1, 1e-5);
    EXPECT_LE(impact.gap, 1e-6 * std::sqrt(3.0));
    EXPECT_GT(impact.counters.volume_tests, 0U);
    EXPECT_GT(impact.counters.primitive_tests, 0U);
}

TEST(TimeOfImpact, TheToleranceBoundsTheGap) {
    const Motion towards = straight({3, 0.3, 0.1}, {-1, 0.3, 0.1});
    for (const double tolerance : {1.0, 0.01, 1e-9, 0.0}) {
        const Impact impact =
            time_of_impact(kBox, Motion::fixed({}), kBox, towards, {.absolute_error = tolerance});
        ASSERT_TRUE(impact.meet);
        EXPECT_LE(impact.gap, std::max(tolerance, 1e-11));
        EXPECT_LE(impact.time, 0.5);
        EXPECT_NEAR(impact.time, 0.5, 0.3 * tolerance + 1e-11);
    }
}

TEST(TimeOfImpact, ABarTurnsIntoABox) {
    // The bar's upper side lies 0.1 above the axis of rotation. It therefore passes the target's
    // corner (2, 1) by asin(0.1 / sqrt(5)) rad before the corner's own angle.
    const Model bar(box_mesh({0, -0.1, -0.1}, {4, 0.1, 0.1}));
    const Model target(box_mesh({2, 1, -1}, {9, 5, 1}));
    const double angle = std::atan2(1.0, 2.0) - std::asin(0.1 / std::sqrt(5.0));
    // Or the bar's end, (4, 0.1), reaches the face y = 1 first.
    const double end_angle = std::asin(1 / std::hypot(4, 0.1)) - std::atan2(0.1, 4);
    const double first = std::min(angle, end_angle);
    expect_hit(bar, spin({0, 0, kPi / 2}), target, Motion::fixed({}), first / (kPi / 2));
    expect_hit(target, Motion::fixed({}), bar, spin({0, 0, kPi / 2}), first / (kPi / 2));
}

TEST(TimeOfImpact, ANeedleTurnsIntoATip) {
    // A needle along x meets the tip of a triangle at an angle of 1 rad.
    const Model needle(Mesh{{{0, 0, 0}, {3, 0, 0}}, {{0, 1, 1}}});
    const Vec3 tip{2 * std::cos(1.0), 2 * std::sin(1.0), 0};
    const Model plate(Mesh{{tip, tip + Vec3{-1, 2, -0.5}, tip + Vec3{-1, 2, 0.5}}, {{0, 1, 2}}});
    const Impact impact = time_of_impact(needle, spin({0, 0, 2}), plate, Motion::fixed({}));
    ASSERT_TRUE(impact.meet);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_NEAR(impact.time, 0.5, 1e-6);
}

TEST(TimeOfImpact, PlatesWithoutThicknessAtAnySpeed) {
    for (const double speed : {2.0, 1e3, 1e6, 1e9}) {
        // Starts at x = -1 and reaches the plate after 1 / speed.
        const Motion through = straight({-1, 0.1, 0.2}, {speed - 1, 0.1, 0.2});
        const Impact impact = time_of_impact(kPlate, Motion::fixed({}), kPlate, through);
        ASSERT_TRUE(impact.meet) << speed;
        EXPECT_LE(impact.time, 1 / speed);
        EXPECT_NEAR(impact.time * speed, 1, 1e-5 + 1e-13 * speed);
    }
}

TEST(TimeOfImpact, AFastSpinningPlateMeetsAThinOne) {
    // The blade turns 10,000 times about z. A point rests within its reach, at a fifth of a turn.
    const Model blade(Mesh{{{0, 0, -1}, {2, 0, -1}, {2, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}});
    const double angle = 0.4 * kPi;
    const Vec3 p{1.5 * std::cos(angle), 1.5 * std::sin(angle), 0};
    const Model point(Mesh{{p}, {{0, 0, 0}}});
    const double rate = 2 * kPi * 1e4;
    const Impact impact = time_of_impact(blade, spin({0, 0, rate}), point, Motion::fixed({}));
    ASSERT_TRUE(impact.meet);
    EXPECT_LE(impact.time, angle / rate);
    EXPECT_NEAR(impact.time, angle / rate, 1e-5 / rate);
}

TEST(TimeOfImpact, InContactAtTheStart) {
    for (const Pose& pose : {at_point(0.5, 0.25, 0.25), at_point(1, 0, 0), at_point(1, 1, 1)}) {
        const Impact impact =
            time_of_impact(kBox, Motion::fixed({}), kBox, Motion::between(pose, at_point(5, 5, 5)));
        EXPECT_TRUE(impact.meet);
        EXPECT_EQ(impact.time, 0);
        EXPECT_EQ(impact.contact_time, 0);
        EXPECT_EQ(impact.gap, 0);
        EXPECT_EQ(impact.status, Status::exact);
        EXPECT_EQ(impact.normal, Vec3{});
        EXPECT_EQ(impact.point_a, impact.point_b);
    }
}

TEST(TimeOfImpact, InContactAtTheEnd) {
    // The faces coincide exactly at t = 1.
    const Impact impact =
        time_of_impact(kBox, Motion::fixed({}), kBox, straight({3, 0, 0}, {1, 0, 0}));
    EXPECT_TRUE(impact.meet);
    EXPECT_NEAR(impact.time, 1, 1e-6);
    EXPECT_LE(impact.time, 1);
}

TEST(TimeOfImpact, ParallelPartingAndEqualMotionsNeverMeet) {
    expect_miss(kBox, Motion::fixed({}), kBox, Motion::fixed(at_point(1.001, 0, 0)));
    expect_miss(kBox, straight({0, 0, 0}, {9, 0, 0}), kBox, straight({0, 1.5, 0}, {-9, 1.5, 0}));
    expect_miss(kBox, Motion::fixed({}), kBox, straight({1.001, 0, 0}, {9, 0, 0}));
    const Motion rolling = Motion::screw({}, turned(3, {0, 0.6, 0.8}, {5, 6, 7}));
    Motion beside = rolling;
    beside.start = at_point(0, 0, 1.25); // part of the same rigid motion: same centre and
                                         // velocities
    expect_miss(kBox, rolling, kBox, beside);
}

TEST(TimeOfImpact, PassingNearIsNoImpact) {
    // Passes nearer than the tolerance, and nearer than the square root of rounding.
    for (const double gap : {1e-3, 1e-7, 1e-10})
        expect_miss(kBox, Motion::fixed({}), kBox, straight({-3, 0, 1 + gap}, {3, 0.5, 1 + gap}));
    // Passes a corner: the spheres of motion almost touch.
    const Model bar(box_mesh({-2, -0.1, -0.1}, {2, 0.1, 0.1}));
    const double reach = std::hypot(2.0, 0.1);
    expect_miss(bar, spin({0, 0, 3}), kBox, Motion::fixed(at_point(reach + 1e-9, -0.5, -0.5)));
    const Impact hit = time_of_impact(bar, spin({0, 0, 3}), kBox,
                                      Motion::fixed(at_point(reach - 1e-6, -0.5, -0.5)));
    EXPECT_TRUE(hit.meet);
}

TEST(TimeOfImpact, SlidingInContactIsAnImpact) {
    // A box slides onto a table whose top is level with the box's bottom. Contact begins when the
    // edges meet.
    const Model table(box_mesh({0, -2, -1}, {4, 2, 0}));
    const Impact impact =
        time_of_impact(table, Motion::fixed({}), kBox, straight({-3, 0, 0}, {1, 0, 0}));
    EXPECT_TRUE(impact.meet);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_NEAR(impact.time, 0.5, 1e-6);
}

TEST(TimeOfImpact, FarFromTheOriginAndAtAnyScale) {
    for (const double scale : {1e-15, 1e-6, 1e6, 1e15}) {
        const Model box(box_mesh({0, 0, 0}, {scale, scale, scale}));
        const Impact impact = time_of_impact(box, Motion::fixed({}), box,
                                             straight({3 * scale, 0, 0}, {-scale, 0, 0}));
        ASSERT_TRUE(impact.meet);
        EXPECT_LE(impact.time, 0.5);
        EXPECT_NEAR(impact.time, 0.5, 1e-6);
        EXPECT_EQ(impact.status, Status::exact);
    }
    const double far = 0x1p20;
    const Impact impact = time_of_impact(kBox, Motion::fixed(at_point(far, far, far)), kBox,
                                         straight({far + 3, far, far}, {far - 1, far, far}));
    ASSERT_TRUE(impact.meet);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_NEAR(impact.time, 0.5, 1e-6);
}

TEST(TimeOfImpact, EmptyModelsMeetNothing) {
    const Model none(Mesh{});
    for (const Model* other : {&none, &kBox}) {
        expect_miss(none, Motion::fixed({}), *other, straight({-1, 0, 0}, {1, 0, 0}));
        expect_miss(*other, Motion::fixed({}), none, straight({-1, 0, 0}, {1, 0, 0}));
    }
}

TEST(TimeOfImpact, PointsAndSegmentsMeet) {
    const Model point(Mesh{{{0, 0, 0}}, {{0, 0, 0}}});
    const Impact points =
        time_of_impact(point, Motion::fixed({}), point, straight({1, 2, 3}, {-1, -2, -3}));
    ASSERT_TRUE(points.meet); // up to rounding: whether the points coincide at any double is chance
    EXPECT_LE(points.time, 0.5);
    EXPECT_NEAR(points.time, 0.5, 1e-6);
    const Model segment(Mesh{{{-1, 0, 0}, {1, 0, 0}}, {{0, 1, 0}}});
    const Impact crossing = time_of_impact(
        segment, Motion::fixed({}), segment,
        Motion::between(turned(1, {0, 0, 1}, {0, 0, -1}), turned(1, {0, 0, 1}, {0, 0, 1})));
    ASSERT_TRUE(crossing.meet);
    EXPECT_NEAR(crossing.time, 0.5, 1e-6);
}

TEST(Motion, EndsWhereItShould) {
    const Pose start = turned(0.7, {0.6, 0, 0.8}, {1, 2, 3}),
               end = turned(-1.9, {0, 0.8, 0.6}, {-4, 5, 0.5});
    for (const Motion& motion :
         {Motion::between(start, end), Motion::between(start, end, {7, 8, 9}),
          Motion::screw(start, end)}) {
        EXPECT_EQ(at(motion, 0), Transform(start));
        const Transform reached = at(motion, 1), wanted(end);
        for (std::size_t i = 0; i < 12; ++i)
            EXPECT_NEAR(reached.m[i], wanted.m[i], 1e-14);
    }
    // The given point moves in a straight line.
    const Vec3 about{7, 8, 9};
    const Motion motion = Motion::between(start, end, about);
    const Vec3 middle = 0.5 * (apply(Transform(start), about) + apply(Transform(end), about));
    EXPECT_LT(length(apply(at(motion, 0.5), about) - middle), 1e-14);
}

TEST(Motion, AScrewTurnsAboutItsAxis) {
    // A quarter turn about the line through (1, 1) along z, rising by 2.
    const Pose start{}, end = turned(kPi / 2, {0, 0, 1}, {2, 0, 2});
    const Motion motion = Motion::screw(start, end);
    EXPECT_LT(length(motion.centre - Vec3{1, 1, 0}), 1e-14);
    EXPECT_LT(length(motion.velocity - Vec3{0, 0, 2}), 1e-14);
    // Half way it has made an eighth of a turn: (1, 1) - R (1, 1).
    const Transform half = at(motion, 0.5);
    EXPECT_NEAR(half.m[9], 1, 1e-14);
    EXPECT_NEAR(half.m[10], 1 - std::sqrt(2.0), 1e-14);
    EXPECT_NEAR(half.m[11], 1, 1e-14);
    // For tiny angles, the axis is far away, but the end is exact.
    for (const double angle : {1e-7, 1e-12, 1e-100, 0.0}) {
        const Pose near = turned(angle, {0, 0, 1}, {2, 3, 4});
        const Transform reached = at(Motion::screw(start, near), 1);
        EXPECT_NEAR(reached.m[9], 2, 1e-14);
        EXPECT_NEAR(reached.m[10], 3, 1e-14);
        EXPECT_NEAR(reached.m[11], 4, 1e-14);
        EXPECT_NEAR(reached.m[1], angle, 1e-14);
    }
}

TEST(Motion, TakesTheShorterArc) {
    Pose end = turned(1, {0, 0, 1});
    for (double& q : end.rotation)
        q *= -3; // the same rotation
    EXPECT_LT(length(Motion::between({}, end).angular_velocity - Vec3{0, 0, 1}), 1e-14);
    EXPECT_NEAR(length(Motion::between({}, turned(2 * kPi - 1, {0, 0, 1})).angular_velocity), 1,
                1e-14);
}

TEST(TimeOfImpact, BadArgumentsAreErrors) {
    const auto expect_bad = [](const auto& query) {
        try {
            (void)query();
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        }
    };
    const Motion still = Motion::fixed({});
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
        for (Motion motion :
             {Motion{at_point(bad, 0, 0), {}, {}, {}}, Motion{{}, {bad, 0, 0}, {}, {}},
              Motion{{}, {}, {0, bad, 0}, {}}, Motion{{}, {}, {}, {0, 0, bad}}}) {
            expect_bad([&] { return time_of_impact(kBox, motion, kBox, still); });
            expect_bad([&] { return time_of_impact(kBox, still, kBox, motion); });
            expect_bad([&] { return time_of_impact(Model(Mesh{}), still, kBox, motion); });
            expect_bad([&] { return at(motion, 0.5); });
        }
        expect_bad([&] { return at(still, bad); });
        expect_bad([&] { return Motion::between({}, at_point(0, bad, 0)); });
    }
    expect_bad([&] { return at(Motion{{{}, {0, 0, 0, 0}}, {}, {}, {}}, 0); });
    expect_bad([&] { return time_of_impact(kBox, spin({1e200, 0, 0}), kBox, still); });
    expect_bad([&] { return time_of_impact(kBox, still, kBox, still, {.absolute_error = -1}); });
    expect_bad([&] {
        return time_of_impact(kBox, still, kBox, still,
                              {.absolute_error = std::numeric_limits<double>::quiet_NaN()});
    });
}

} // namespace
} // namespace abut::test
