#include <abut/error.h>
#include <abut/rigid.h>

#include "tests/support/infinity.h"
#include "tests/support/shapes.h"
#include "tests/unit/rigid/unit_box.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

TEST(Rigid, BoxesByHand) {
    const Gap gap = distance(kBox, Pose{}, kBox, Pose{{4, 5, 0}, {1, 0, 0, 0}});
    EXPECT_EQ(gap.distance, 5);
    EXPECT_EQ(gap.point_a.x, 1);
    EXPECT_EQ(gap.point_a.y, 1);
    EXPECT_EQ(gap.point_b.x, 4);
    EXPECT_EQ(gap.point_b.y, 5);
    EXPECT_TRUE(within(kBox, Pose{}, kBox, translation(4, 5, 0), 5));
    EXPECT_FALSE(within(kBox, Pose{}, kBox, translation(4, 5, 0), 4.9999999999999991));
    EXPECT_TRUE(collide(kBox, Pose{}, kBox, translation(1, 0, 0)).meet()); // face to face
    EXPECT_TRUE(collide(kBox, Pose{}, kBox, translation(1, 1, 1)).meet()); // one corner
    EXPECT_FALSE(collide(kBox, Pose{}, kBox, translation(1, 1, 1.0000000000000002)).meet());
    const Gap least = distance(kBox, Pose{}, kBox, translation(0, 0, 1.0000000000000002));
    EXPECT_EQ(least.distance, 0x1p-52);
}

TEST(Rigid, APartInsideAClosedOneDoesNotCollide) {
    const Model inner(box_mesh({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}));
    EXPECT_FALSE(collide(kBox, Pose{}, inner, Pose{}).meet());
    EXPECT_EQ(distance(kBox, Pose{}, inner, Pose{}).distance, 0.25);
}

/// The squared distance underflows, but the models are still apart.
TEST(Rigid, DistancesThatUnderflowAreNotZero) {
    const Mesh low = box_mesh({0, 0, 0}, {1, 1, 1}), high = box_mesh({0, 0, -1}, {1, 1, -0x1p-700});
    const Gap gap = distance(Model(low), Pose{}, Model(high), Pose{});
    EXPECT_GT(gap.distance, 0);
    EXPECT_LT(gap.distance, 1e-150);
    EXPECT_FALSE(collide(Model(low), Pose{}, Model(high), Pose{}).meet());
}

TEST(Rigid, EmptyModelsMeetNothing) {
    const Model none(Mesh{});
    const Model loose(Mesh{{{0, 0, 0}}, {}}); // a vertex without a triangle
    for (const Model& empty : {none, loose}) {
        EXPECT_FALSE(collide(empty, Pose{}, kBox, Pose{}).meet());
        EXPECT_FALSE(collide(kBox, Pose{}, empty, Pose{}).meet());
        EXPECT_FALSE(collide(empty, Pose{}, empty, Pose{}).meet());
        EXPECT_EQ(distance(empty, Pose{}, kBox, Pose{}).distance, kInfinity);
        EXPECT_EQ(distance(empty, Pose{}, kBox, Pose{}).status, Status::bound_only);
        EXPECT_EQ(distance(kBox, Pose{}, empty, Pose{}, {.upper_bound = 3}).distance, 3);
        EXPECT_FALSE(within(empty, Pose{}, kBox, Pose{}, 1e9));
    }
}

TEST(Rigid, DegenerateModelsAreSegmentsAndPoints) {
    const Model point(Mesh{{{2, 0.5, 0.5}}, {{0, 0, 0}}});
    EXPECT_EQ(distance(kBox, Pose{}, point, Pose{}).distance, 1);
    EXPECT_FALSE(collide(kBox, Pose{}, point, Pose{}).meet());
    EXPECT_TRUE(collide(kBox, Pose{}, point, translation(-1, 0, 0)).meet());
    EXPECT_TRUE(collide(point, Pose{}, point, Pose{}).meet());
    const Model segment(Mesh{{{0.5, 0.5, -1}, {0.5, 0.5, 3}}, {{0, 1, 0}}});
    EXPECT_EQ(collide(kBox, Pose{}, segment, translation(0, 0.25, 0), {.mode = ContactMode::all})
                  .pairs.size(),
              2U);
}

TEST(Rigid, SingularTransforms) {
    // Flattened into a plane that cuts the other box, and into a point.
    EXPECT_TRUE(collide(kBox, scaling(1, 1, 0), kBox, translation(0.1, 0.1, -0.5)).meet());
    EXPECT_EQ(distance(kBox, scaling(1, 1, 0), kBox, translation(0, 0, 2)).distance, 2);
    EXPECT_EQ(distance(kBox, scaling(0, 0, 0), kBox, translation(3, 0, 0)).distance, 3);
    EXPECT_TRUE(within(kBox, scaling(0, 0, 0), kBox, translation(3, 0, 0), 3));
    EXPECT_EQ(distance(kBox, scaling(1, 0x1p-600, 1), kBox, translation(0, 2, 0)).distance, 2);
}

void expect_bad(const auto& query) {
    try {
        (void)query();
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()), "");
    }
}

TEST(Rigid, BadArgumentsAreErrors) {
    Transform bad;
    bad.m[4] = std::numeric_limits<double>::quiet_NaN();
    Transform endless;
    endless.m[10] = kInfinity;
    for (const Transform& t : {bad, endless}) {
        expect_bad([&] { return collide(kBox, t, kBox, Pose{}); });
        expect_bad([&] { return collide(kBox, Pose{}, kBox, t); });
        expect_bad([&] { return distance(kBox, t, kBox, Pose{}); });
        expect_bad([&] { return within(kBox, Pose{}, kBox, t, 1); });
    }
    expect_bad([&] { return within(kBox, Pose{}, kBox, Pose{}, -1); });
    expect_bad([&] {
        return within(kBox, Pose{}, kBox, Pose{}, std::numeric_limits<double>::quiet_NaN());
    });
    expect_bad([&] { return distance(kBox, Pose{}, kBox, Pose{}, {.upper_bound = -0.5}); });
    expect_bad([&] {
        return distance(kBox, Pose{}, kBox, Pose{},
                        {.upper_bound = std::numeric_limits<double>::quiet_NaN()});
    });
    EXPECT_TRUE(within(kBox, Pose{}, kBox, translation(1e6, 0, 0), kInfinity));
}

TEST(Rigid, UpperBoundIsNotReached) {
    // A distance equal to the bound is not below it.
    const Gap at = distance(kBox, Pose{}, kBox, translation(3, 0, 0), {.upper_bound = 2});
    EXPECT_EQ(at.distance, 2);
    EXPECT_EQ(at.status, Status::bound_only);
    const Gap below =
        distance(kBox, Pose{}, kBox, translation(3, 0, 0), {.upper_bound = 2.0000000000000004});
    EXPECT_EQ(below.distance, 2);
    EXPECT_EQ(below.status, Status::exact);
}

TEST(Rigid, CountersCount) {
    const Contacts c =
        collide(kBox, Pose{}, kBox, translation(1, 0, 0), {.mode = ContactMode::all});
    EXPECT_GT(c.counters.volume_tests, 0U);
    EXPECT_GT(c.counters.primitive_tests, 0U);
    EXPECT_GT(c.counters.exact_tests, 0U);
}

} // namespace
} // namespace abut::test
