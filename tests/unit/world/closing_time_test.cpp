// Times to close a gap, worked by hand, and against small steps.

#include "math/vector.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "world/schedule/closing_time.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Just below the value.
void expect_just_below(double time, double value) {
    EXPECT_LE(time, value);
    EXPECT_NEAR(time, value, 1e-9 * value);
}

TEST(ClosingTime, OfAGapAlongADirection) {
    RelativeMotion motion;
    const Vec3 x{1, 0, 0};
    EXPECT_EQ(time_along(motion, x, 1), kNoCollision); // at rest
    EXPECT_EQ(time_along(motion, x, 0), 0);
    EXPECT_EQ(time_along(motion, x, -1), 0);
    motion.velocity = {2, 100, 0};
    expect_just_below(time_along(motion, x, 6), 3); // only the speed along the gap counts
    EXPECT_EQ(time_along(motion, -x, 6), kNoCollision);
    motion.acceleration = {-0.5, 0, 0}; // turns round at t = 4, after 4
    EXPECT_EQ(time_along(motion, x, 4.1), kNoCollision);
    expect_just_below(time_along(motion, x, 3.75), 3);
    motion.acceleration = {2, 0, 0}, motion.velocity = {-1, 0, 0}; // -t + t^2 = 6
    expect_just_below(time_along(motion, x, 6), 3);
    motion = {};
    motion.a = {{0, 0, 1}, 0, 0, 2}; // turns about z: no speed along z, 2 along x
    EXPECT_GT(time_along(motion, {0, 0, 1}, 6), 1e9);
    expect_just_below(time_along(motion, x, 6), 3);
    motion.b = {{}, 0.5, 2, 1}; // 2.5 t + t^2
    expect_just_below(time_along(motion, x, 6), 1.5);
    EXPECT_EQ(time_along(motion, {NAN, 0, 0}, 1), 0);
}

TEST(ClosingTime, OfADistance) {
    RelativeMotion motion;
    motion.velocity = {0, 3, 0}, motion.speed = 1, motion.acceleration_bound = 2; // 4 t + t^2
    expect_just_below(time_from_distance(motion, 12), 2);
    EXPECT_EQ(time_from_distance(motion, kNoCollision), kNoCollision);
    EXPECT_EQ(time_from_distance(motion, 0), 0);
}

TEST(ClosingTime, OfBalls) {
    RelativeMotion motion;
    motion.a.reach = 1, motion.b.reach = 0.5;
    motion.velocity = {-1, 0, 0};
    expect_just_below(time_of_balls(motion, {3.5, 0, 0}, 10), 2);
    EXPECT_EQ(time_of_balls(motion, {-3.5, 0, 0}, 10), kNoCollision);  // they part
    EXPECT_EQ(time_of_balls(motion, {3.5, 1.6, 0}, 10), kNoCollision); // they pass
    EXPECT_EQ(time_of_balls(motion, {1.5, 0, 0}, 10), 0);
    motion.speed = 0.25;
    expect_just_below(time_of_balls(motion, {4, 0, 0}, 10), 2);
}

/// The bodies may be anywhere in balls, and all bounds are used to the full.
TEST(ClosingTime, BallsNeverMeetEarlier) {
    Random random(5301);
    int met = 0, good = 0;
    for (int round = 0; round < many(4000); ++round) {
        const auto some = [&](double most) {
            return random.chance(0.5) ? 0 : random.uniform(0, most);
        };
        RelativeMotion motion;
        motion.velocity = some(2) * random.direction();
        motion.acceleration = some(2) * random.direction();
        motion.speed = some(0.5), motion.acceleration_bound = some(0.5);
        motion.a.reach = random.uniform(0, 1), motion.b.reach = random.uniform(0, 1);
        const Vec3 between = random.uniform(0.5, 6) * random.direction();
        const double free = time_of_balls(motion, between, 10);
        for (int i = 0; i <= 400; ++i) {
            const double t = 0.02 * i;
            const Vec3 at = between + t * motion.velocity + (0.5 * t * t) * motion.acceleration;
            const double slack = t * motion.speed + 0.5 * t * t * motion.acceleration_bound;
            if (length(at) - slack > motion.a.reach + motion.b.reach)
                continue;
            EXPECT_LE(free, t);
            ++met, good += free > 0.4 * t ? 1 : 0;
            break;
        }
    }
    EXPECT_GT(met, many(4000) / 4);
    EXPECT_GT(good, met / 2);
}

} // namespace
} // namespace abut::test
