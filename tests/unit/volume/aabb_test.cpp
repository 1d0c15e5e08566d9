#include "tests/support/random.h"
#include "volume/aabb.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(Aabb, RoundsOutward) {
    EXPECT_EQ(round_down(1.0), 1.0F);
    EXPECT_EQ(round_up(1.0), 1.0F);
    EXPECT_EQ(round_down(1 + 0x1p-40), 1.0F);
    EXPECT_EQ(round_up(1 + 0x1p-40), 1 + 0x1p-23F);
    EXPECT_EQ(round_down(1 - 0x1p-40), 1 - 0x1p-24F);
    EXPECT_EQ(round_up(1 - 0x1p-40), 1.0F);
    EXPECT_EQ(round_down(0x1p-1074), 0.0F);
    EXPECT_EQ(round_up(0x1p-1074), 0x1p-149F);
    EXPECT_EQ(round_down(-0x1p-1074), -0x1p-149F);
    EXPECT_EQ(round_down(1e300), std::numeric_limits<float>::max());
    EXPECT_EQ(round_up(1e300), std::numeric_limits<float>::infinity());
    EXPECT_EQ(round_down(-1e300), -std::numeric_limits<float>::infinity());
    EXPECT_EQ(round_up(-1e300), -std::numeric_limits<float>::max());
}

TEST(Aabb, RoundsNoFartherThanOneStep) {
    Random random(701);
    int inexact = 0;
    for (int i = 0; i < 100000; ++i) {
        const double v = std::ldexp(random.uniform(-1, 1), random.integer(-160, 127));
        const float low = round_down(v), high = round_up(v);
        ASSERT_LE(double{low}, v);
        ASSERT_GE(double{high}, v);
        ASSERT_TRUE(low == high || std::nextafterf(low, HUGE_VALF) == high);
        inexact += low != high ? 1 : 0;
    }
    EXPECT_GT(inexact, 90000);
}

TEST(Aabb, MergeAreaAndEmptiness) {
    Aabb box;
    EXPECT_EQ(box.half_area(), 0);
    box.merge(Aabb(Box3{{0, 0, 0}, {1, 2, 3}}));
    EXPECT_EQ(box.half_area(), 2 + 6 + 3);
    box.merge(Aabb());
    EXPECT_EQ(box.half_area(), 11);
    box.merge(Aabb(Box3{{-1, 0, 0}, {0, 0, 0}}));
    EXPECT_EQ(box.half_area(), 4 + 6 + 6);
    EXPECT_EQ(Aabb(Box3{{0, 0, 0}, {1, 1, 1}}, 1).lower[2], -1.0F);
    EXPECT_EQ(Aabb(Box3{{0, 0, 0}, {1, 1, 1}}, 1).upper[0], 2.0F);
}

} // namespace
} // namespace abut::test
