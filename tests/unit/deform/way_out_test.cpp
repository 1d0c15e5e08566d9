#include "deform/bodies/way_out.h"
#include "tests/support/random.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

TEST(WayOut, OfFewFaces) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    EXPECT_EQ(way_out({}), Vec3{});
    EXPECT_EQ(way_out(std::vector{z}), z);
    EXPECT_EQ(way_out(std::vector{z, z, z}), z);
    const Vec3 bisector = way_out(std::vector{x, y, x, x});
    EXPECT_NEAR(bisector.x, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(bisector.y, std::sqrt(0.5), 1e-15);
    EXPECT_EQ(bisector.z, 0);
    const Vec3 corner = way_out(std::vector{x, y, z});
    for (const double each : {corner.x, corner.y, corner.z})
        EXPECT_NEAR(each, std::sqrt(1.0 / 3), 0.01);
    // A notch of 2 degrees.
    const double s = std::sin(M_PI / 180), c = std::cos(M_PI / 180);
    const Vec3 out = way_out(std::vector<Vec3>{{s, c, 0}, {s, -c, 0}});
    EXPECT_NEAR(out.x, 1, 1e-12);
}

TEST(WayOut, NoneWhereNoVectorLeavesAllFaces) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0};
    EXPECT_EQ(way_out(std::vector{x, -x}), Vec3{});
    EXPECT_EQ(way_out(std::vector{x, y, -x, -y}), Vec3{});
    EXPECT_EQ(way_out(std::vector<Vec3>{
                  x, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}, {0, 0, 1}}),
              Vec3{});
}

/// Many faces around a vertex, whose normals are all within some angle of an axis.
TEST(WayOut, OfManyFacesAroundAVertex) {
    Random random(1966);
    int wide = 0;
    for (int round = 0; round < 200; ++round) {
        const double lowest = random.uniform(0.02, 0.9); // dot product with the axis
        const Vec3 axis = random.direction();
        std::vector<Vec3> normals;
        for (int i = random.integer(1, 40); i > 0;) {
            const Vec3 normal = random.direction();
            if (dot(normal, axis) < lowest)
                continue;
            normals.push_back(normal), --i;
        }
        const Vec3 out = way_out(normals);
        ASSERT_NEAR(length(out), 1, 1e-12);
        for (const Vec3& normal : normals)
            ASSERT_GT(dot(out, normal), 0.98 * lowest);
        wide += lowest < 0.2 ? 1 : 0;
    }
    EXPECT_GT(wide, 20);
}

} // namespace
} // namespace abut::test
