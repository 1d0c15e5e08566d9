#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_penetration.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Triangle moved(const Triangle& t, const Vec3& by) {
    return {t[0] + by, t[1] + by, t[2] + by};
}

TEST(TrianglePenetration, TheSeparatingMotionIsTheShortest) {
    Random random(601);
    int crossing = 0, sharp = 0;
    for (int i = 0; i < 20000; ++i) {
        const Triangle a = random.triangle(), b = random.triangle();
        if (triangle_triangle_intersect(a, b) != TriangleContact::cross)
            continue;
        ++crossing;
        const auto [depth, direction] = triangle_triangle_penetration(a, b);
        ASSERT_GT(depth, 0);
        ASSERT_NEAR(length(direction), 1, 1e-14);
        // Moved by a part in 10^12 more than the depth, they are apart; by one percent less, they
        // still meet.
        ASSERT_EQ(
            triangle_triangle_intersect(a, moved(b, (depth * (1 + 1e-12) + 1e-14) * direction)),
            TriangleContact::none);
        sharp += triangle_triangle_intersect(a, moved(b, 0.99 * depth * direction)) !=
                         TriangleContact::none
                     ? 1
                     : 0;
        for (int k = 0; k < 40; ++k) {
            const Vec3 shorter = depth * (1 - 1e-9) * random.direction();
            ASSERT_NE(triangle_triangle_intersect(a, moved(b, shorter)), TriangleContact::none);
        }
    }
    EXPECT_GT(crossing, 2000);
    EXPECT_EQ(sharp, crossing);
}

TEST(TrianglePenetration, TouchingTrianglesHaveNoDepth) {
    Random random(602);
    int touching = 0;
    for (int i = 0; i < 50000; ++i) {
        const Triangle a = random.lattice_triangle(3), b = random.lattice_triangle(3);
        if (triangle_triangle_intersect(a, b) != TriangleContact::touch)
            continue;
        const auto [depth, direction] = triangle_triangle_penetration(a, b);
        ASSERT_GE(depth, 0);
        if (direction == Vec3{}) { // two points
            ASSERT_EQ(depth, 0);
            continue;
        }
        ++touching;
        ASSERT_NEAR(length(direction), 1, 1e-14);
    }
    EXPECT_GT(touching, 5000);
}

} // namespace
} // namespace abut::test
