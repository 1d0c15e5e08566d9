#include <abut/error.h>

#include "math/transform.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Transform, FormulaIsColumnMajor) {
    const Transform t({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    EXPECT_EQ(apply(t, {1, 0, 0}), (Vec3{11, 13, 15}));
    EXPECT_EQ(apply(t, {0, 1, 0}), (Vec3{14, 16, 18}));
    EXPECT_EQ(apply(t, {0, 0, 1}), (Vec3{17, 19, 21}));
    EXPECT_EQ(apply_linear(t, {1, 1, 1}), (Vec3{12, 15, 18}));
}

TEST(Transform, EvaluatedLeftToRightWithoutFusedOperations) {
    // 1 + 2^-53 rounds to 1 at every step. Summed from right to left, the two halves would add up.
    const Transform t({1, 0, 0, 0x1p-53, 1, 0, 0x1p-53, 0, 1, 0, 0, 0});
    EXPECT_EQ(apply(t, {1, 1, 1}).x, 1.0);
    // A fused multiply-add would keep the last bits of the square.
    const double a = 1 + 0x1p-52;
    const Transform u({a, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0});
    EXPECT_EQ(apply(u, {a, -(1 + 0x1p-51), 0}).x, 0.0);
}

TEST(Transform, QuaternionNeedNotBeOfUnitLength) {
    // A quarter turn about z maps x to y.
    for (const double scale : {1.0, -3.0, 1e-200, 1e200}) {
        const Vec3 p = apply(Pose{{1, 2, 3}, {scale, 0, 0, scale}}, {1, 0, 0});
        EXPECT_NEAR(p.x, 1, 1e-15);
        EXPECT_NEAR(p.y, 3, 1e-15);
        EXPECT_NEAR(p.z, 3, 1e-15);
    }
    EXPECT_EQ(Transform(Pose{}), Transform());
}

void expect_bad(const Pose& pose, const char* word) {
    try {
        const Transform t(pose);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(Transform, BadPosesAreErrors) {
    expect_bad({{0, 0, 0}, {0, 0, 0, 0}}, "zero length");
    expect_bad({{0, 0, 0}, {1, kNaN, 0, 0}}, "not finite");
    expect_bad({{0, 0, 0}, {kInfinity, 0, 0, 0}}, "not finite");
    expect_bad({{0, kNaN, 0}, {1, 0, 0, 0}}, "not finite");
    expect_bad({{0, 0, -kInfinity}, {1, 0, 0, 0}}, "not finite");
    EXPECT_NO_THROW(Transform(Pose{{0, 0, 0}, {0, 0, 0x1p-1074, 0}}));
}

TEST(Transform, LargeFiniteQuaternionsAreValid) {
    // The sum of the components overflows, although each component is finite.
    constexpr double kMost = std::numeric_limits<double>::max();
    const Vec3 p = apply(Pose{{0, 0, 0}, {kMost, 0, 0, kMost}}, {1, 0, 0});
    EXPECT_NEAR(p.y, 1, 1e-15);
}

TEST(Transform, StretchOfSpecialMaps) {
    EXPECT_NEAR(stretch_of({}).least, 1, 1e-12);
    EXPECT_NEAR(stretch_of({}).most, 1, 1e-12);
    EXPECT_LE(stretch_of({}).least, 1);
    EXPECT_GE(stretch_of({}).most, 1);
    const Transform flat({1, 0, 0, 0, 2, 0, 0, 0, 0, 5, 5, 5});
    EXPECT_EQ(stretch_of(flat).least, 0);
    EXPECT_NEAR(stretch_of(flat).most, 2, 2e-5);
    const Transform nothing({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3});
    EXPECT_EQ(stretch_of(nothing).least, 0);
    EXPECT_EQ(stretch_of(nothing).most, 0);
    EXPECT_FALSE(std::isfinite(inverse(flat).m[8]));
}

TEST(Transform, RequireFiniteNamesTheBadValue) {
    Transform t;
    EXPECT_NO_THROW(require_finite(t, "pose of b"));
    t.m[7] = kNaN;
    try {
        require_finite(t, "pose of b");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()).find("pose of b"), std::string::npos);
    }
}

} // namespace
} // namespace abut
