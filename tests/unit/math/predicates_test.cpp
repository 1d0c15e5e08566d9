#include "math/predicates.h"

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Predicates, Handedness) {
    const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    EXPECT_EQ(orient3d(o, x, y, z), 1);
    EXPECT_EQ(orient3d(o, y, x, z), -1);
    EXPECT_EQ(orient3d(o, x, y, {5, -3, 0}), 0);
    EXPECT_EQ(orient2d(o, x, y, 2), 1); // along z, onto xy
    EXPECT_EQ(orient2d(o, y, z, 0), 1); // along x, onto yz
    EXPECT_EQ(orient2d(o, z, x, 1), 1); // along y, onto zx
    EXPECT_EQ(orient2d(o, x, {2, 0, 7}, 2), 0);
}

TEST(Predicates, OneUnitInTheLastPlaceDecides) {
    const Vec3 a{0.1, 0.1, 0}, b{0.7, 0.7, 0}, c{0.3, 0.3, 1};
    EXPECT_EQ(orient3d(a, b, c, {0.5, 0.5, 0.25}), 0);
    EXPECT_EQ(orient3d(a, b, c, {0.5, 0.5 + 0x1p-53, 0.25}),
              -orient3d(a, b, c, {0.5, 0.5 - 0x1p-54, 0.25}));
    EXPECT_NE(orient3d(a, b, c, {0.5, 0.5 + 0x1p-53, 0.25}), 0);
    EXPECT_TRUE(collinear({0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}, {0.3, 0.3, 0.3}));
    EXPECT_FALSE(collinear({0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}, {0.3, 0.3, 0.3 + 0x1p-54}));
}

TEST(Predicates, ExtremeMagnitudes) {
    constexpr double kHuge = 0x1p1023, kTiny = 0x1p-1074;
    EXPECT_EQ(orient3d({-kHuge, 0, 0}, {kHuge, 0, 0}, {0, kHuge, 0}, {0, 0, kTiny}), 1);
    EXPECT_EQ(orient3d({0, 0, 0}, {kTiny, 0, 0}, {0, kTiny, 0}, {0, 0, kTiny}), 1);
    EXPECT_EQ(orient3d({0, 0, 0}, {kTiny, 0, 0}, {0, kTiny, 0}, {0, 0, -kTiny}), -1);
    EXPECT_EQ(orient2d({0, 0, 0}, {kTiny, 0, 0}, {0, kTiny, 0}, 2), 1);
    EXPECT_FALSE(collinear({0, 0, 0}, {kTiny, 0, 0}, {0, 0, kTiny}));
    EXPECT_TRUE(collinear({kHuge, kHuge, kHuge}, {0, 0, 0}, {kTiny, kTiny, kTiny}));
    EXPECT_EQ(orient3d({0.0, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0);
}

} // namespace
} // namespace abut
