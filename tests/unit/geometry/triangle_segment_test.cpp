// The common points of two triangles, by hand.

#include <abut/rigid.h>

#include "geometry/triangle_triangle_segment.h"
#include "tests/support/shapes.h"
#include "tests/unit/geometry/floor.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

std::vector<Vec3> shared(const Triangle& a, const Triangle& b) {
    const Intersection i = triangle_triangle_segment(a, b);
    return {i.corners.begin(), i.corners.begin() + i.count};
}

TEST(TriangleSegment, RunsAlongTheCrossProductOfTheNormals) {
    // n_a = +z and the wall's normal is -y, so n_a x n_b = +x.
    const Triangle wall{Vec3{1, 1, -1}, Vec3{2, 1, -1}, Vec3{1, 1, 1}};
    EXPECT_EQ(shared(kFloor, wall), (std::vector<Vec3>{{1, 1, 0}, {1.5, 1, 0}}));
    EXPECT_EQ(shared(wall, kFloor), (std::vector<Vec3>{{1.5, 1, 0}, {1, 1, 0}}));
    const Triangle turned{wall[0], wall[2], wall[1]};
    EXPECT_EQ(shared(kFloor, turned), (std::vector<Vec3>{{1.5, 1, 0}, {1, 1, 0}}));
}

TEST(TriangleSegment, EndsAtTheBoundaryOfEither) {
    const Triangle wide{Vec3{-9, 1, -9}, Vec3{9, 1, -9}, Vec3{0, 1, 9}};
    EXPECT_EQ(shared(kFloor, wide), (std::vector<Vec3>{{0, 1, 0}, {3, 1, 0}}));
    const Triangle half_out{Vec3{2, 1, -1}, Vec3{6, 1, -1}, Vec3{2, 1, 1}};
    EXPECT_EQ(shared(kFloor, half_out), (std::vector<Vec3>{{2, 1, 0}, {3, 1, 0}}));
}

TEST(TriangleSegment, TouchingAndMissing) {
    using Points = std::vector<Vec3>;
    EXPECT_EQ(shared(kFloor, {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{2, 1, 1}}), Points({{1, 1, 0}}));
    EXPECT_EQ(shared(kFloor, {Vec3{4, 0, 0}, Vec3{5, 0, 1}, Vec3{5, 1, 1}}), Points({{4, 0, 0}}));
    EXPECT_EQ(shared(kFloor, {Vec3{2, 0, -1}, Vec3{2, 0, 1}, Vec3{2, -1, 0}}), Points({{2, 0, 0}}));
    EXPECT_EQ(shared(kFloor, {Vec3{1, 1, 0}, Vec3{2, 1, 0}, Vec3{1, 1, 1}}).size(), 2U);
    EXPECT_TRUE(shared(kFloor, {Vec3{1, 1, 0x1p-1000}, Vec3{1, 1, 1}, Vec3{2, 1, 1}}).empty());
    EXPECT_TRUE(shared(kFloor, {Vec3{3, 3, -1}, Vec3{3, 3, 1}, Vec3{4, 4, 1}}).empty());
}

TEST(TriangleSegment, CoplanarTrianglesShareAPolygon) {
    const Triangle same = kFloor;
    EXPECT_EQ(shared(kFloor, same).size(), 3U);
    const Triangle inside{Vec3{1, 1, 0}, Vec3{1, 2, 0}, Vec3{2, 1, 0}}; // clockwise
    const auto three = shared(kFloor, inside);
    ASSERT_EQ(three.size(), 3U);
    EXPECT_GT(cross(three[1] - three[0], three[2] - three[0]).z, 0); // in the sense of n_a
    EXPECT_LT(cross(shared(inside, kFloor)[1] - shared(inside, kFloor)[0],
                    shared(inside, kFloor)[2] - shared(inside, kFloor)[0])
                  .z,
              0);
    const Triangle star{Vec3{3, 3, 0}, Vec3{-1, 3, 0}, Vec3{3, -1, 0}};
    EXPECT_EQ(shared(kFloor, star).size(), 6U);
    const Triangle beside{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, -4, 0}}; // along an edge
    EXPECT_EQ(shared(kFloor, beside).size(), 2U);
    const Triangle at_corner{Vec3{4, 0, 0}, Vec3{6, 0, 0}, Vec3{6, 1, 0}};
    EXPECT_EQ(shared(kFloor, at_corner), (std::vector<Vec3>{{4, 0, 0}}));
}

TEST(TriangleSegment, DegenerateTrianglesAreSegmentsAndPoints) {
    const Triangle stick{Vec3{1, 1, -1}, Vec3{1, 1, 3}, Vec3{1, 1, 0}};
    EXPECT_EQ(shared(kFloor, stick), (std::vector<Vec3>{{1, 1, 0}}));
    EXPECT_EQ(shared(stick, kFloor), (std::vector<Vec3>{{1, 1, 0}}));
    const Triangle lying{Vec3{-1, 1, 0}, Vec3{9, 1, 0}, Vec3{-1, 1, 0}};
    EXPECT_EQ(shared(kFloor, lying).size(), 2U);
    const Triangle point{Vec3{1, 1, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 0}};
    EXPECT_EQ(shared(kFloor, point), (std::vector<Vec3>{{1, 1, 0}}));
    EXPECT_EQ(shared(point, point), (std::vector<Vec3>{{1, 1, 0}}));
    EXPECT_EQ(shared(stick, lying), (std::vector<Vec3>{{1, 1, 0}}));
    const Triangle skew{Vec3{-1, 1.5, 0}, Vec3{9, 1.5, 0}, Vec3{-1, 1.5, 0}};
    EXPECT_TRUE(shared(stick, skew).empty());
}

/// The planes differ by one part in 2^50, so wide arithmetic computes the point.
TEST(TriangleSegment, AlmostCoplanar) {
    const double e = 0x1p-50;
    const Triangle tilted{Vec3{0.5, 1, e}, Vec3{2.5, 1, -3 * e}, Vec3{2.5, 1.5, -3 * e}};
    const auto points = shared(kFloor, tilted); // z = 0 at x = 1
    ASSERT_EQ(points.size(), 2U);
    for (const Vec3& p : points)
        EXPECT_NEAR(p.x, 1, 1e-10);
}

TEST(Collide, SegmentsComeWithThePairs) {
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1}));
    const Contacts c = collide(box, Pose{}, box, translation(0.5, 0.2, 0.3),
                               {.mode = ContactMode::all, .segments = true});
    ASSERT_EQ(c.segments.size(), c.pairs.size());
    double length_in_face = 0; // x = 1 is cut along two sides, of lengths 0.8 and 0.7
    for (const Intersection& s : c.segments) {
        ASSERT_EQ(s.count, 2U);
        if (s.corners[0].x == 1 && s.corners[1].x == 1)
            length_in_face += length(s.corners[1] - s.corners[0]);
    }
    EXPECT_NEAR(length_in_face, 1.5, 1e-14);
    EXPECT_TRUE(collide(box, Pose{}, box, translation(0.5, 0.25, 0.25)).segments.empty());
    EXPECT_EQ(collide(box, Pose{}, box, translation(0, 0, 1), {.segments = true}).segments.size(),
              1U);
}

} // namespace
} // namespace abut::test
