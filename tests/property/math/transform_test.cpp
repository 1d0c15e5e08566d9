#include "math/transform.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Transform random_linear(Random& random, int kind) {
    Transform t = random.pose(10);
    if (kind == 1) // uneven scale, some mirrored
        t = compose(t, Transform({random.uniform(-5, 5), 0, 0, 0, random.uniform(0.01, 5), 0, 0, 0,
                                  random.uniform(0.01, 5), 0, 0, 0}));
    if (kind == 2) // shear
        t = compose(t, Transform({1, random.uniform(-3, 3), random.uniform(-3, 3), 0, 1,
                                  random.uniform(-3, 3), 0, 0, 1, 0, 0, 0}));
    if (kind == 3) // any linear map
        for (double& v : t.m)
            v = random.uniform(-1, 1);
    if (kind == 4) // singular to rounding: the third column is a combination of the others
        for (std::size_t i = 0; i < 3; ++i)
            t.m[6 + i] = 0.3 * t.m[i] - 1.7 * t.m[3 + i];
    return t;
}

TEST(Transform, StretchBoundsHoldInEveryDirection) {
    Random random(201);
    int tight = 0, maps = 0;
    for (int kind = 0; kind < 5; ++kind)
        for (int i = 0; i < 60; ++i, ++maps) {
            const Transform t = random_linear(random, kind);
            const auto [least, most] = stretch_of(t);
            double seen_least = HUGE_VAL, seen_most = 0;
            for (int k = 0; k < 2000; ++k) {
                const Vec3 d = random.direction();
                const double stretch = length(apply_linear(t, d)) / length(d);
                seen_least = std::min(seen_least, stretch);
                seen_most = std::max(seen_most, stretch);
            }
            ASSERT_LE(least, seen_least * (1 + 1e-14)) << "kind " << kind;
            ASSERT_GE(most, seen_most * (1 - 1e-14)) << "kind " << kind;
            ASSERT_GE(least, 0);
            if (kind == 0) {
                ASSERT_NEAR(least, 1, 1e-5);
                ASSERT_NEAR(most, 1, 1e-5);
            }
            // The extremes of 2,000 directions come within a few percent of the true extremes.
            tight += most < seen_most * 1.02 && (kind == 4 || least > seen_least * 0.8) ? 1 : 0;
            if (kind == 4) {
                ASSERT_LT(least, 1e-6 * most);
            }
        }
    EXPECT_GT(tight, maps * 8 / 10);
}

TEST(Transform, InverseAndComposeUndoEachOther) {
    Random random(202);
    for (int kind = 0; kind < 4; ++kind)
        for (int i = 0; i < 200; ++i) {
            const Transform t = random_linear(random, kind), u = random_linear(random, 0);
            const Vec3 p = random.in_cube(10);
            const auto [least, most] = stretch_of(t);
            const double condition = most / least;
            if (!(condition < 1e6))
                continue;
            const Vec3 back = apply(inverse(t), apply(t, p));
            ASSERT_LT(length(back - p), 1e-12 * condition * condition) << "kind " << kind;
            const Vec3 once = apply(compose(u, t), p), twice = apply(u, apply(t, p));
            ASSERT_LT(length(once - twice), 1e-12 * (1 + length(twice)));
        }
}

} // namespace
} // namespace abut::test
