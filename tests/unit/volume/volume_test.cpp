// Volumes fitted to shapes, with sizes known by hand.

#include "volume/fit/convex_hull.h"
#include "volume/fit/principal_axes.h"
#include "volume/lower_bound.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// The vertices of a box, each as a triangle degenerate to a point.
std::vector<Triangle> corners(const Vec3& lower, const Vec3& upper) {
    std::vector<Triangle> result;
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3 p{(i & 1U) != 0 ? upper.x : lower.x, (i & 2U) != 0 ? upper.y : lower.y,
                     (i & 4U) != 0 ? upper.z : lower.z};
        result.push_back({p, p, p});
    }
    return result;
}
Transform shift(double x, double y, double z) {
    return Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z});
}

constexpr double kFloatRounding = 1e-6;

TEST(Volumes, VolumesOfABox) {
    const auto box = corners({1, 2, 3}, {9, 6, 5}); // half extents 4, 2, 1 about 5, 4, 4
    const Obb obb = Obb::fit(box);
    EXPECT_EQ(obb.centre, (std::array{5.0F, 4.0F, 4.0F}));
    EXPECT_NEAR(obb.half[0], 4, kFloatRounding);
    EXPECT_NEAR(obb.half[1], 2, kFloatRounding);
    EXPECT_NEAR(obb.half[2], 1, kFloatRounding);
    EXPECT_NEAR(std::abs(obb.axis[0][0]), 1, kFloatRounding);

    EXPECT_NEAR(BoundingSphere::fit(box).radius, std::sqrt(21), 1e-5);
    EXPECT_NEAR(Pss::fit(box).radius, std::sqrt(21), 1e-5);

    const Rss rss = Rss::fit(box);
    EXPECT_NEAR(rss.radius, 1, kFloatRounding);
    EXPECT_NEAR(rss.axes[0].half, 4, kFloatRounding);
    EXPECT_NEAR(rss.axes[1].half, 2, kFloatRounding);

    const Lss lss = Lss::fit(box);
    EXPECT_NEAR(lss.radius, std::sqrt(5), 1e-5);
    EXPECT_NEAR(lss.axes[0].half, 4, kFloatRounding);

    const Kdop26 kdop = Kdop26::fit(box);
    EXPECT_EQ(kdop.lower[0], 1);
    EXPECT_EQ(kdop.upper[2], 5);
    EXPECT_NEAR(kdop.upper[3], 6 + 5, kFloatRounding * 10); // y + z
    EXPECT_NEAR(kdop.lower[4], 2 - 5, kFloatRounding * 10); // y - z
    EXPECT_NEAR(kdop.upper[9], 9 + 6 + 5, kFloatRounding * 10);
}

TEST(Volumes, InsetsReachRoundEnds) {
    // Points of a capsule: the segment from -1 to 1 with radius 0.5, and the caps at its ends.
    std::vector<Triangle> capsule;
    for (const double x : {-1.0, 1.0})
        for (int i = 0; i < 12; ++i) {
            const double a = i * 0.5235987755982988;
            const Vec3 ring{x, 0.5 * std::cos(a), 0.5 * std::sin(a)}, tip{1.5 * x, 0, 0};
            capsule.push_back({ring, tip, ring});
        }
    const Lss lss = Lss::fit(capsule);
    EXPECT_NEAR(lss.radius, 0.5, 1e-4);
    EXPECT_NEAR(lss.axes[0].half, 1, 1e-4);
}

TEST(Volumes, GapsAlongAnAxisAndAcrossACorner) {
    const auto box = corners({-1, -1, -1}, {1, 1, 1});
    const auto gap = [&]<typename V>(const V& v, const Transform& t) {
        return distance_lower_bound(v, v,
                                    typename V::Map(make_relative_pose(t, v.reach(), v.reach())));
    };
    const Obb obb = Obb::fit(box);
    EXPECT_NEAR(gap(obb, shift(5, 0, 0)), 3, 1e-4);
    EXPECT_NEAR(gap(obb, shift(5, 6, 2)), 5, 1e-4); // 3, 4, 0
    EXPECT_EQ(gap(obb, shift(1.9, 0, 0)), 0);
    const Kdop18 kdop = Kdop18::fit(box);
    EXPECT_NEAR(gap(kdop, shift(5, 6, 2)), 5, 1e-4);
    EXPECT_NEAR(gap(kdop, shift(5, 5, 0)), 3 * std::sqrt(2), 1e-4);
    const BoundingSphere sphere = BoundingSphere::fit(box);
    EXPECT_NEAR(gap(sphere, shift(5, 0, 0)), 5 - 2 * std::sqrt(3), 1e-4);
    EXPECT_EQ(gap(sphere, shift(3, 0, 0)), 0);

    // A plate above a plate, and beside it.
    const Rss plate = Rss::fit(corners({-2, -1, 0}, {2, 1, 0}));
    EXPECT_NEAR(gap(plate, shift(0.3, 0.1, 0.25)), 0.25, 1e-4);
    EXPECT_NEAR(gap(plate, shift(7, 6, 12)), 13, 1e-4); // 3, 4, 12
    EXPECT_EQ(gap(plate, shift(1, 1, 0)), 0);
    const Transform upright({0, 0, 1, 0, 1, 0, -1, 0, 0, 0, 0, 2.5});
    EXPECT_NEAR(gap(plate, upright), 0.5, 1e-4); // its short edge above the other's face
}

TEST(Volumes, SsvTakesTheKindThatFits) {
    // A cube, a rod and a plate.
    EXPECT_EQ(Ssv::fit(corners({-1, -1, -1}, {1, 1, 1})).dimension(), 0U);
    EXPECT_EQ(Ssv::fit(corners({-20, -1, -1}, {20, 1, 1})).dimension(), 1U);
    EXPECT_EQ(Ssv::fit(corners({-20, -20, -1}, {20, 20, 1})).dimension(), 2U);
    // One point, one segment.
    EXPECT_EQ(
        Ssv::fit(std::vector<Triangle>{{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}}}).dimension(),
        0U);
    EXPECT_EQ(
        Ssv::fit(std::vector<Triangle>{{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{4, 5, 6}}}).dimension(),
        1U);
}

TEST(Volumes, GapsBetweenSsvOfAllKinds) {
    // Cores that extend 2 along x, or 2 along x and 1 along y, swept by 0.25.
    const auto core = [](std::size_t dimension) {
        Ssv swept;
        swept.radius = 0.25F;
        if (dimension > 0)
            swept.axes[0] = {{1, 0, 0}, 2};
        if (dimension > 1)
            swept.axes[1] = {{0, 1, 0}, 1};
        return swept;
    };
    const auto gap = [&](std::size_t a, std::size_t b, const Transform& t) {
        const RelativePose pose = make_relative_pose(t, 4, 4);
        EXPECT_EQ(image_of(core(b), pose).dimension, b);
        return distance_lower_bound(core(a), core(b), pose);
    };
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            SCOPED_TRACE(testing::Message() << a << ' ' << b);
            const double reach_x = (a > 0 ? 2 : 0) + (b > 0 ? 2 : 0),
                         reach_y = (a > 1 ? 1 : 0) + (b > 1 ? 1 : 0);
            EXPECT_NEAR(gap(a, b, shift(0, 0, 3)), 2.5, 1e-4);
            EXPECT_NEAR(gap(a, b, shift(reach_x + 3, 0, 4)), 4.5, 1e-4);
            EXPECT_NEAR(gap(a, b, shift(0, reach_y + 3, 4)), 4.5, 1e-4);
            EXPECT_NEAR(gap(a, b, shift(reach_x + 3, reach_y + 4, 12)), 12.5, 2e-4);
            // b stands upright, with its x along z: its lower end is 2 below its middle.
            const Transform upright({0, 0, 1, 0, 1, 0, -1, 0, 0, 0, 0, 3});
            EXPECT_NEAR(gap(a, b, upright), b > 0 ? 0.5 : 2.5, 1e-4);
            EXPECT_EQ(gap(a, b, shift(0, 0, 0.4)), 0);
        }
}

TEST(Volumes, UpperBoundsReachTheFarEnds) {
    const Rss plate = Rss::fit(corners({-3, -4, 0}, {3, 4, 0}));
    VolumeBatch<Rss> batch;
    for (std::size_t lane = 0; lane < 8; ++lane)
        batch.set(lane, plate);
    VolumeBounds bounds{};
    bound_distances(batch, image_of(plate, make_relative_pose(shift(0, 0, 10), 5, 5)), bounds);
    for (const float upper_sq : bounds.upper_sq)
        EXPECT_NEAR(upper_sq, 400, 0.1); // two half diagonals of 5 and the shift
}

TEST(ConvexHull, BoxWithPointsInside) {
    std::vector<Vec3> points{{0.5, 0.5, 0.5}, {0.2, 0.7, 0.1}};
    for (const Triangle& t : corners({0, 0, 0}, {1, 1, 1}))
        points.push_back(t[0]);
    const auto hull = convex_hull(points);
    EXPECT_EQ(hull.size(), 12U);
    double area = 0;
    for (const Triangle& t : hull)
        area += 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
    EXPECT_NEAR(area, 6, 1e-12);
}

TEST(ConvexHull, PointsThatSpanNoVolume) {
    EXPECT_TRUE(convex_hull({}).empty());
    EXPECT_TRUE(convex_hull(std::vector<Vec3>(10, Vec3{1, 2, 3})).empty());
    EXPECT_TRUE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).empty());
    EXPECT_TRUE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).empty());
}

TEST(PrincipalAxes, WidestFirst) {
    const Axes axes =
        principal_axes(std::vector<Triangle>{{Vec3{0, 0, 0}, Vec3{0, 9, 0}, Vec3{1, 9, 0}},
                                             {Vec3{0, 0, 0}, Vec3{1, 9, 0}, Vec3{1, 0, 0}}});
    EXPECT_NEAR(std::abs(axes[0].y), 1, 1e-12);
    EXPECT_NEAR(std::abs(axes[1].x), 1, 1e-12);
    EXPECT_NEAR(std::abs(axes[2].z), 1, 1e-12);
}

} // namespace
} // namespace abut::test
