// The times for which boxes, balls and triangles stay apart: nothing meets before.

#include <abut/rigid.h>

#include "rigid/model_data.h"
#include "rigid/motion_bounds.h"
#include "rigid/moving_boxes.h"
#include "rigid/moving_triangles.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Towards the origin, more or less.
Motion random_motion(Random& random) {
    const Pose pose = random.pose(0.8);
    const Vec3 centre = pose.translation + random.in_cube(0.5);
    const Vec3 velocity = random.in_cube(0.5) - random.uniform(0, 4) * pose.translation;
    const Vec3 spin = random.uniform(0, random.chance(0.3) ? 15 : 2) * random.direction();
    return {pose, centre, velocity, random.chance(0.2) ? Vec3{} : spin};
}

MovingPair moving_pair(const Model& a, const Motion& motion_a, const Model& b,
                       const Motion& motion_b) {
    return {a.data().tree(), a.data().model_from_tree(), motion_a,
            b.data().tree(), b.data().model_from_tree(), motion_b};
}

/// Whether the models meet at some of many times in [begin, end).
bool meet_within(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b,
                 double begin, double end) {
    constexpr int kSamples = 40;
    for (int i = 0; i < kSamples; ++i) {
        // Half of them close to the end, where a bound that is too long shows.
        const double part = i % 2 == 0 ? double(i) / kSamples : 1 - std::pow(0.7, i);
        const double t = begin + part * (end - begin);
        if (collide(a, at(motion_a, t), b, at(motion_b, t)).any())
            return true;
    }
    return false;
}

struct Tally {
    int proven = 0, never = 0, tight = 0;
    void expect_some(int cases) const {
        EXPECT_GT(proven, cases / 5);
        EXPECT_GT(never, cases / 50);
        EXPECT_GT(tight, cases / 50); // soon after, some do meet
    }
};

/// A time is proven from `begin` on for two models that do not meet there.
void check(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b,
           double begin, double free, Tally& tally) {
    if (!(free > 0))
        return;
    ++tally.proven;
    tally.never += free > 1 - begin ? 1 : 0;
    const double end = std::min(1.0, begin + free);
    ASSERT_FALSE(meet_within(a, motion_a, b, motion_b, begin, end));
    tally.tight +=
        free < 1 && meet_within(a, motion_a, b, motion_b, end, std::min(1.0, begin + 1.5 * free))
            ? 1
            : 0;
}

TEST(MotionBounds, Boxes) {
    Random random(2200);
    constexpr int kCases = 1000;
    Tally tally;
    for (int i = 0; i < kCases; ++i) {
        const auto flat = [&] { return random.chance(0.2) ? 0 : random.uniform(0.02, 0.8); };
        const Vec3 half_a{flat(), flat(), flat()}, half_b{flat(), flat(), flat()};
        const Model a(box_mesh(-half_a, half_a)), b(box_mesh(-half_b, half_b));
        const Motion motion_a = random_motion(random), motion_b = random_motion(random);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const double begin = random.chance(0.3) ? 0 : random.uniform(0, 1);
        const Moment moment(pair, begin);
        const MovingBox box_a = box_of_a(pair, moment, root_box(a.data().tree(), pair.a.scale)),
                        box_b = box_of_b(pair, moment, root_box(b.data().tree(), pair.b.scale));
        const double enough = random.chance(0.5) ? 0.1 : 1;
        check(a, motion_a, b, motion_b, begin,
              free_time(pair, moment, box_a, box_b, enough, 1 - begin), tally);
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    tally.expect_some(kCases);
}

TEST(MotionBounds, Triangles) {
    Random random(2201);
    constexpr int kCases = 1000;
    Tally tally;
    for (int i = 0; i < kCases; ++i) {
        const auto one = [&] {
            Triangle t = random.triangle(random.uniform(0.05, 1));
            if (random.chance(0.1))
                t[2] = t[1];
            return Model(Mesh{{t[0], t[1], t[2]}, {{0, 1, 2}}});
        };
        const Model a = one(), b = one();
        const Motion motion_a = random_motion(random), motion_b = random_motion(random);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const double begin = random.chance(0.3) ? 0 : random.uniform(0, 1);
        const Triangle world_a = a.data().world_triangle(0, at(motion_a, begin)),
                       world_b = b.data().world_triangle(0, at(motion_b, begin));
        const ClosestPoints closest = triangle_triangle_distance(world_a, world_b);
        if (closest.distance_sq == 0)
            continue;
        check(a, motion_a, b, motion_b, begin, free_time(pair, begin, world_a, world_b, closest),
              tally);
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    tally.expect_some(kCases);
}

TEST(MotionBounds, BallsInStraightMotionExactly) {
    // 3 - 2 s = 1; passing at a distance of 1 with radii of 1 less or more a little.
    EXPECT_NEAR(free_time({3, 0, 0}, {-2, 0, 0}, 0, 1, 10), 1, 1e-11);
    EXPECT_LE(free_time({3, 0, 0}, {-2, 0, 0}, 0, 1, 10), 1);
    EXPECT_EQ(free_time({3, 1, 0}, {-2, 0, 0}, 0, 1 - 1e-14, 10), HUGE_VAL);
    EXPECT_NEAR(free_time({3, 1, 0}, {-2, 0, 0}, 0, 1 + 1e-14, 10), 1.5, 1e-6);
    EXPECT_EQ(free_time({3, 0, 0}, {2, 0, 0}, 0, 1, 10), HUGE_VAL);
    EXPECT_EQ(free_time({0.5, 0, 0}, {2, 0, 0}, 0, 1, 10), 0);
    // At rest, the radii grow by s^2: found by halves, from below.
    EXPECT_LE(free_time({3, 0, 0}, {}, 2, 1, 10), std::sqrt(2.0));
    EXPECT_GT(free_time({3, 0, 0}, {}, 2, 1, 10), 0.7);
    EXPECT_EQ(free_time({3, 0, 0}, {}, 2, 1, 1.25), HUGE_VAL);
}

TEST(MotionBounds, ApproachesByHand) {
    // 2 - s - s^2 = 0 at s = 1; a speed of at most 4 proves half of that.
    const double second = free_time({2, 1, 2, 4});
    EXPECT_NEAR(second, 1, 1e-11);
    EXPECT_LE(second, 1);
    EXPECT_NEAR(free_time({2, 1, 100, 2}), 1, 1e-11); // the first order is better
    EXPECT_NEAR(free_time({3, -2, 2, 9}), 3, 1e-11);  // parting: 3 + 2 s - s^2
    EXPECT_EQ(free_time({1, -1, 0, 1}), HUGE_VAL);
    EXPECT_EQ(free_time({1, 1, 1, 0}), HUGE_VAL);
    EXPECT_EQ(free_time({0, -1, 0, 1}), 0);
}

} // namespace
} // namespace abut::test
