// Bounds on how much nearer points of two bodies may have come, against sampled points.

#include "pieces/relative_motion.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(RelativeMotion, NoTwoPointsApproachMoreThanTheBound) {
    Random random(8109);
    int tight = 0;
    for (int i = 0; i < many(3000); ++i) {
        const BodyBall a{random.in_cube(), random.uniform(0, 1)},
            b{random.in_cube(), random.uniform(0, 1)};
        const bool rigid = i % 3 != 0, a_stands = i % 2 == 0;
        const auto step = [&](const Transform& from) {
            const Vec3 v = std::sin(random.uniform(0, 0.1)) * random.direction();
            const Transform turn(Pose{random.in_cube(0.1), {1, v.x, v.y, v.z}});
            return compose(turn, rigid ? from : compose(from, scaling(1.1, 0.9, 1)));
        };
        const PosePair from{
            compose(translation(random.uniform(-9, 9), 0, 0), random.linear_map(!rigid)),
            compose(translation(0, random.uniform(-9, 9), 0), random.linear_map(!rigid))};
        const PosePair to{a_stands ? from.a : step(from.a), step(from.b)};
        const double bound = most_approach(from, to, a, b);
        double most = 0;
        for (int k = 0; k < 30; ++k) {
            const Vec3 p = a.middle + a.radius * random.direction(),
                       q = b.middle + b.radius * random.direction();
            most = std::max(most, length(apply(from.b, q) - apply(from.a, p)) -
                                      length(apply(to.b, q) - apply(to.a, p)));
        }
        ASSERT_LE(most, bound) << i;
        tight += most > 0.3 * bound ? 1 : 0;
        // Bodies that move together do not approach.
        if (rigid) {
            const Transform together = random.pose(3);
            const PosePair moved{compose(together, from.a), compose(together, from.b)};
            ASSERT_LE(most_approach(from, moved, a, b), 1e-9);
        }
    }
    EXPECT_GE(tight, many(3000) / 15);
}

/// A matrix that is a rotation only up to rounding stretches, which moves points too.
TEST(RelativeMotion, RotationsStretchByRounding) {
    Random random(8111);
    for (int i = 0; i < many(1000); ++i) {
        const BodyBall ball{{}, 1};
        const Transform turn = random.pose(0);
        Transform stretched = turn;
        const int column = random.integer(0, 2);
        for (int k = 0; k < 3; ++k)
            stretched.m[3 * static_cast<std::size_t>(column) + static_cast<std::size_t>(k)] *=
                1 + 0x1p-46;
        const PosePair from{{}, turn}, to{{}, stretched};
        // The point at the end of the stretched axis moves by this much.
        const double way = 0x1p-46;
        ASSERT_GE(most_approach(from, to, ball, ball), way);
        ASSERT_LE(most_approach(from, to, ball, ball), 0x1p-38);
    }
}

} // namespace
} // namespace abut::test
