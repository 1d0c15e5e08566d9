#include "geometry/triangle_triangle_penetration.h"

#include <gtest/gtest.h>

namespace abut {
namespace {

const Triangle kWideFloor{Vec3{-9, -9, 0}, Vec3{9, -9, 0}, Vec3{0, 9, 0}};

TEST(TrianglePenetration, AVertexThroughAFloor) {
    const auto [depth, direction] = triangle_triangle_penetration(
        kWideFloor, {Vec3{0, 0, -0.25}, Vec3{1, 0, 2}, Vec3{0, 1, 2}});
    EXPECT_DOUBLE_EQ(depth, 0.25);
    EXPECT_EQ(direction, (Vec3{0, 0, 1}));
    const auto swapped = triangle_triangle_penetration(
        {Vec3{0, 0, -0.25}, Vec3{1, 0, 2}, Vec3{0, 1, 2}}, kWideFloor);
    EXPECT_DOUBLE_EQ(swapped.depth, 0.25);
    EXPECT_EQ(swapped.direction, (Vec3{0, 0, -1}));
}

TEST(TrianglePenetration, EdgeAcrossEdge) {
    // Two upright triangles. Their edges along x and along y pass each other by 0.125.
    const Triangle a{Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0, -5}},
        b{Vec3{0, -1, -0.125}, Vec3{0, 1, -0.125}, Vec3{0, 0, 5}};
    const auto [depth, direction] = triangle_triangle_penetration(a, b);
    EXPECT_DOUBLE_EQ(depth, 0.125);
    EXPECT_EQ(direction, (Vec3{0, 0, 1}));
}

TEST(TrianglePenetration, Degenerate) {
    const Vec3 p{0, 0, 0};
    EXPECT_EQ(triangle_triangle_penetration({p, p, p}, {p, p, p}).depth, 0);
    EXPECT_EQ(triangle_triangle_penetration({p, p, p}, {p, p, p}).direction, Vec3{});
    EXPECT_EQ(triangle_triangle_penetration(kWideFloor, kWideFloor).depth, 0);
    const auto [depth, direction] = triangle_triangle_penetration(kWideFloor, {p, p, {0, 0, 3}});
    EXPECT_DOUBLE_EQ(depth, 0);
    EXPECT_EQ(direction, (Vec3{0, 0, 1}));
}

} // namespace
} // namespace abut
