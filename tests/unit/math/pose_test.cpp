// Products, inverses and images of poses.

#include <abut/error.h>
#include <abut/pose.h>
#include <abut/vector.h>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-15);
    EXPECT_NEAR(a.y, b.y, 1e-15);
    EXPECT_NEAR(a.z, b.z, 1e-15);
}

double size_of(const Pose& pose) {
    double sum = 0;
    for (const double value : pose.rotation)
        sum += value * value;
    return std::sqrt(sum);
}

// A quarter turn about z: x becomes y. One of its quaternions is of unit length, one is not.
const Pose kQuarter{{1, 2, 3}, {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}};
const Pose kLongQuarter{{1, 2, 3}, {5, 0, 0, 5}};
// A half turn about x.
const Pose kHalf{{0, 0, 4}, {0, 1, 0, 0}};

TEST(Pose, TakesPointsAndDirections) {
    for (const Pose& pose : {kQuarter, kLongQuarter}) {
        expect_near(apply(pose, {1, 0, 0}), {1, 3, 3});
        expect_near(rotate(pose, {1, 0, 0}), {0, 1, 0});
    }
}

TEST(Pose, AProductAppliesTheSecondFactorFirst) {
    const Pose product = kQuarter * kHalf;
    // (0, 1, 0) becomes (0, -1, 4) by the half turn, and (2, 2, 7) by the quarter turn.
    expect_near(apply(product, {0, 1, 0}), {2, 2, 7});
    expect_near(apply(kHalf * kQuarter, {0, 1, 0}), {0, -2, 1});
    EXPECT_NEAR(size_of(kLongQuarter * kHalf), 1, 1e-15);
}

TEST(Pose, AnInverseUndoesIt) {
    for (const Pose& pose : {kQuarter, kLongQuarter, kHalf, kQuarter * kHalf}) {
        expect_near(apply(inverse(pose), apply(pose, {7, -5, 2})), {7, -5, 2});
        const Pose none = inverse(pose) * pose;
        expect_near(none.translation, {});
        EXPECT_NEAR(std::abs(none.rotation[0]), 1, 1e-15);
    }
}

// Squares of these components overflow, and vanish.
TEST(Pose, TakesQuaternionsOfAnyLength) {
    for (const double size : {1e-300, 1e300}) {
        const Pose pose{{1, 2, 3}, {size, 0, 0, size}};
        expect_near(apply(pose * kHalf, {0, 1, 0}), {2, 2, 7});
        expect_near(apply(inverse(pose), {1, 3, 3}), {1, 0, 0});
    }
}

TEST(Pose, RefusesWhatIsNoPose) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Pose& bad : {Pose{{}, {0, 0, 0, 0}}, Pose{{}, {nan, 0, 0, 1}}, Pose{{nan, 0, 0}}}) {
        EXPECT_THROW((void)(bad * kHalf), Error);
        EXPECT_THROW((void)(kHalf * bad), Error);
        EXPECT_THROW((void)inverse(bad), Error);
        EXPECT_THROW((void)apply(bad, {}), Error);
        EXPECT_THROW((void)rotate(bad, {}), Error);
    }
}

TEST(Error, CodesHaveNames) {
    EXPECT_STREQ(to_string(ErrorCode::bad_argument), "bad_argument");
    EXPECT_STREQ(to_string(ErrorCode::file_not_found), "file_not_found");
    EXPECT_STREQ(to_string(ErrorCode::interrupted), "interrupted");
}

} // namespace
} // namespace abut::test
