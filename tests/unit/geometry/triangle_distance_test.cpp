// Cases worked by hand, and cases reduced from failures of the property tests.

#include "geometry/triangle_triangle_distance.h"
#include "tests/unit/geometry/floor.h"

#include <gtest/gtest.h>

namespace abut {
namespace {

void expect(const ClosestPoints& c, double distance, const Vec3& a, const Vec3& b) {
    EXPECT_DOUBLE_EQ(c.distance_sq, distance * distance);
    EXPECT_EQ(c.a, a);
    EXPECT_EQ(c.b, b);
}

TEST(Distance, Segments) {
    const auto d = segment_segment_distance;
    expect(d({0, 0, 0}, {2, 0, 0}, {1, -1, 3}, {1, 1, 3}), 3, {1, 0, 0}, {1, 0, 3});
    expect(d({0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}), 1, {2, 0, 0}, {3, 0, 0});
    expect(d({0, 0, 0}, {0, 0, 0}, {3, 4, 0}, {3, 4, 0}), 5, {0, 0, 0}, {3, 4, 0});
    expect(d({1, 2, 0}, {1, 2, 0}, {0, 0, 0}, {2, 0, 0}), 2, {1, 2, 0}, {1, 0, 0});
    EXPECT_DOUBLE_EQ(d({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {5, 1, 0}).distance_sq, 1); // parallel
    EXPECT_EQ(d({0, 0, 0}, {2, 2, 2}, {2, 0, 1}, {0, 2, 1}).distance_sq, 0);        // they cross
}

TEST(Distance, PointAndTriangle) {
    expect(point_triangle_distance({1, 1, 3}, kFloor), 3, {1, 1, 3}, {1, 1, 0});
    expect(point_triangle_distance({2, -2, 0}, kFloor), 2, {2, -2, 0}, {2, 0, 0});
    expect(point_triangle_distance({-3, -4, 0}, kFloor), 5, {-3, -4, 0}, {0, 0, 0});
    const Vec3 p{1, 0, 0}, q{3, 0, 0};
    expect(point_triangle_distance({2, 0, 2}, {p, q, p}), 2, {2, 0, 2}, {2, 0, 0}); // a segment
    expect(point_triangle_distance({1, 0, 2}, {p, p, p}), 2, {1, 0, 2}, {1, 0, 0}); // a point
}

TEST(Distance, Triangles) {
    expect(triangle_triangle_distance(kFloor, {Vec3{1, 1, 2}, Vec3{1, 2, 3}, Vec3{2, 1, 3}}), 2,
           {1, 1, 0}, {1, 1, 2});
    expect(triangle_triangle_distance(kFloor, {Vec3{5, 0, 0}, Vec3{9, 0, 0}, Vec3{9, 9, 0}}), 1,
           {4, 0, 0}, {5, 0, 0});
    // Pierced: both points are the piercing point.
    expect(triangle_triangle_distance(kFloor, {Vec3{1, 1, -1}, Vec3{1, 1, 1}, Vec3{9, 9, 0}}), 0,
           {1, 1, 0}, {1, 1, 0});
}

/// The foot was once rounded to the grid of coordinates near 10^5 before the distance was taken.
/// The error was 1,400 roundings of the coordinates' differences.
TEST(Distance, FarFromTheOriginCoordinatesRoundNothingAway) {
    const Triangle a{Vec3{-0x1.58c5283fe6b6ap+13, -0x1.0fdc0c86001bbp+16, 0x1.edda47c60d3bep+15},
                     Vec3{-0x1.58d23ba52c881p+13, -0x1.0fdb1cd65d225p+16, 0x1.edd7f520f96d1p+15},
                     Vec3{-0x1.58d2c9affd9a8p+13, -0x1.0fdbe81a4f048p+16, 0x1.eddb63dccb1a4p+15}},
        b{Vec3{-0x1.58cc03b8b73f4p+13, -0x1.0fdb52ba7343ap+16, 0x1.edd94cb40ac2fp+15},
          Vec3{-0x1.58d2fca0a77ebp+13, -0x1.0fdaf274b5f71p+16, 0x1.edda46b74d4ddp+15},
          Vec3{-0x1.58cb2533d117ap+13, -0x1.0fda79c02ef3cp+16, 0x1.edd892a53d8bep+15}};
    EXPECT_NEAR(std::sqrt(triangle_triangle_distance(a, b).distance_sq), 0.25711258993949071,
                2e-15);
}

/// A segment that rounding has turned into a triangle: its plane is meaningless, its edges are
/// exact. The foot on that plane was once taken for the answer.
TEST(Distance, Needle) {
    const Triangle needle{Vec3{0, 0, 0}, Vec3{0.7, 0.7, 0.7}, Vec3{0.1, 0.1, 0.1 + 0x1p-56}};
    for (int i = 0; i <= 20; ++i) {
        const double x = 0.035 * i;
        const ClosestPoints c = point_triangle_distance({x + 0x1p-30, x - 0x1p-30, x}, needle);
        EXPECT_NEAR(std::sqrt(c.distance_sq), 0x1p-30 * std::sqrt(2), 4e-16) << x;
    }
}

} // namespace
} // namespace abut
