// Every volume encloses what it was fitted to, decided with 100 digits, and is not much larger.

#include "tests/support/tree/volumes.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <typename V>
class VolumeFit : public testing::Test {};

using Volumes = testing::Types<BoundingSphere, Pss, Lss, Rss, Ssv, Obb, Kdop14, Kdop18, Kdop26>;
TYPED_TEST_SUITE(VolumeFit, Volumes);

template <typename V>
void expect_encloses(const V& volume, const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles)
        for (const Vec3& p : t) {
            ASSERT_TRUE(encloses(volume, p));
            ASSERT_LE(length(p), volume.reach());
        }
}

TYPED_TEST(VolumeFit, EnclosesItsTriangles) {
    Random random(1101);
    for (int i = 0; i < 210; ++i) {
        const auto triangles = any_triangles(random, i);
        SCOPED_TRACE(i);
        expect_encloses(TypeParam::fit(triangles), triangles);
    }
}

TYPED_TEST(VolumeFit, EnclosesTrianglesOfExtremeSize) {
    Random random(1102);
    for (const double scale : {1e18, 1e6, 1e-6, 1e-18, 1e-37, 1e-41, 1e-60, 1e-200, 1e-310})
        for (int i = 0; i < 21; ++i) {
            auto triangles = any_triangles(random, 3 * i + 1);
            for (Triangle& t : triangles)
                for (Vec3& p : t)
                    p = 1e-4 * scale * p;
            SCOPED_TRACE(scale);
            expect_encloses(TypeParam::fit(triangles), triangles);
        }
}

TYPED_TEST(VolumeFit, EnclosesPointsMovedByTheMargin) {
    Random random(1103);
    for (int i = 0; i < 100; ++i) {
        const auto triangles = any_triangles(random, i);
        const double margin = std::pow(10.0, random.integer(-9, 0));
        const TypeParam volume = TypeParam::fit(triangles, margin);
        for (const Triangle& t : triangles)
            for (const Vec3& p : t) {
                const auto shift = [&] { return random.chance(0.5) ? margin : -margin; };
                const double x = shift(), y = shift(), z = shift();
                // The rounded sum has moved by at most the margin.
                const Vec3 moved = p + (1 - 1e-9) * Vec3{x, y, z};
                const Vec3 by = moved - p;
                if (std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}) <= margin) {
                    ASSERT_TRUE(encloses(volume, moved)) << i;
                }
            }
    }
}

TYPED_TEST(VolumeFit, MergedEnclosesBoth) {
    Random random(1104);
    for (int i = 0; i < 140; ++i) {
        const auto first = any_triangles(random, i), second = any_triangles(random, 5 * i + 2);
        const TypeParam a = TypeParam::fit(first), b = TypeParam::fit(second);
        const TypeParam both = TypeParam::merge(a, b);
        SCOPED_TRACE(i);
        expect_encloses(both, first);
        expect_encloses(both, second);
        expect_encloses(TypeParam::merge(a, a), first);
    }
}

/// The corners of a box, or of the core of a swept sphere.
std::vector<Vec3> corners_of(const Obb& box) {
    std::vector<Vec3> corners;
    for (unsigned c = 0; c < 8; ++c) {
        Vec3 p{box.centre[0], box.centre[1], box.centre[2]};
        for (unsigned i = 0; i < 3; ++i)
            p = p + ((c >> i & 1U) != 0 ? 1.0 : -1.0) * double{box.half[i]} *
                        Vec3{box.axis[i][0], box.axis[i][1], box.axis[i][2]};
        corners.push_back(p);
    }
    return corners;
}
template <std::size_t n>
std::vector<Vec3> corners_of(const SweptSphere<n>& swept) {
    std::vector<Vec3> corners;
    for (unsigned c = 0; c < 1U << n; ++c) {
        Vec3 p{swept.centre[0], swept.centre[1], swept.centre[2]};
        for (unsigned i = 0; i < n; ++i) {
            const auto& d = swept.axes[i].direction;
            p = p + ((c >> i & 1U) != 0 ? 1.0 : -1.0) * double{swept.axes[i].half} *
                        Vec3{d[0], d[1], d[2]};
        }
        corners.push_back(p);
    }
    return corners;
}

template <typename V>
void expect_merge_encloses_volumes(double radius_of(const V&)) {
    Random random(1105);
    for (int i = 0; i < 300; ++i) {
        const V a = V::fit(any_triangles(random, i)), b = V::fit(any_triangles(random, 3 * i + 1));
        const V both = V::merge(a, b);
        for (const V* part : {&a, &b})
            for (const Vec3& p : corners_of(*part)) {
                // The corner is itself rounded here.
                const double rounding = 0x1p-50 * length(p);
                V grown = both;
                if constexpr (std::is_same_v<V, Obb>)
                    for (float& h : grown.half)
                        h += static_cast<float>(rounding);
                else
                    grown.radius += static_cast<float>(rounding);
                ASSERT_TRUE(encloses(grown, p, radius_of(*part))) << i;
            }
    }
}
TEST(VolumeMerge, EnclosesTheVolumesThemselves) {
    expect_merge_encloses_volumes<Obb>([](const Obb&) { return 0.0; });
    expect_merge_encloses_volumes<BoundingSphere>(
        [](const BoundingSphere& s) { return double{s.radius}; });
    expect_merge_encloses_volumes<Pss>([](const Pss& s) { return double{s.radius}; });
    expect_merge_encloses_volumes<Lss>([](const Lss& s) { return double{s.radius}; });
    expect_merge_encloses_volumes<Rss>([](const Rss& s) { return double{s.radius}; });
    expect_merge_encloses_volumes<Ssv>([](const Ssv& s) { return double{s.radius}; });
}

/// A turned box of these half sizes around the origin, with 2 * parts^2 triangles on each side.
std::vector<Triangle> turned_box(const Transform& turn, const Vec3& half, int parts) {
    std::vector<Triangle> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            for (int i = 0; i < parts; ++i)
                for (int j = 0; j < parts; ++j) {
                    const auto at = [&](int u, int v) {
                        std::array<double, 3> x{};
                        const auto k = static_cast<std::size_t>(axis);
                        x[k] = side;
                        x[(k + 1) % 3] = 2.0 * u / parts - 1;
                        x[(k + 2) % 3] = 2.0 * v / parts - 1;
                        return apply(turn, {x[0] * half.x, x[1] * half.y, x[2] * half.z});
                    };
                    triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                    triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
                }
    return triangles;
}

TEST(VolumeFit, FindsATurnedBox) {
    Random random(1106);
    for (int i = 0; i < 40; ++i) {
        const Vec3 half{1, 0.5, 0.2};
        const Transform turn = random.pose(10);
        auto triangles = turned_box(turn, half, i % 2 == 0 ? 1 : 8);
        // A very fine mesh at one corner changes the statistics of the surface, but not the hull.
        for (int k = 0; k < 400; ++k)
            triangles.push_back({apply(turn, {1, 0.5, 0.2}),
                                 apply(turn, {0.999, 0.5 - random.uniform(0, 0.001), 0.2}),
                                 apply(turn, {0.999, 0.5, 0.2 - random.uniform(0, 0.001)})});
        const Obb box = Obb::fit(triangles);
        EXPECT_LT(box.half[0] * box.half[1] * box.half[2], 0.1 * 1.001);
        EXPECT_LT(box.circumradius(), length(half) * 1.001);
        const Rss rss = Rss::fit(triangles);
        EXPECT_LT(rss.radius, 0.2 * 1.001);
        EXPECT_LT(rss.axes[0].half, 1.001);
        EXPECT_LT(rss.axes[1].half, 0.501);
        // The rectangle's ends are inset by the radius, but not its corners.
        EXPECT_LT(Lss::fit(triangles).radius, std::hypot(0.5, 0.2) * 1.001);
        EXPECT_LT(Pss::fit(triangles).radius, length(half) * 1.001);
    }
}

TEST(VolumeFit, SpheresAreNearlySmallest) {
    Random random(1107);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<Triangle> triangles;
        const double radius = random.uniform(0.1, 10);
        const Vec3 centre = random.in_cube(10);
        for (int k = 0; k < 60; ++k) {
            Triangle t;
            for (Vec3& p : t)
                p = centre + radius * random.direction();
            triangles.push_back(t);
        }
        worst = std::max(worst, BoundingSphere::fit(triangles).radius / radius);
    }
    EXPECT_LT(worst, 1.02);
    // For an obtuse triangle the longest side is the diameter.
    const std::vector<Triangle> obtuse{{Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0.1, 0.2, 0}}};
    EXPECT_NEAR(BoundingSphere::fit(obtuse).radius, 1, 1e-6);
    const std::vector<Triangle> even{
        {Vec3{1, 0, 0}, Vec3{-0.5, std::sqrt(0.75), 0}, Vec3{-0.5, -std::sqrt(0.75), 0}}};
    EXPECT_NEAR(BoundingSphere::fit(even).radius, 1, 1e-6);
}

TEST(VolumeFit, FlatAndThinSetsHaveThinVolumes) {
    Random random(1108);
    for (int i = 0; i < 100; ++i) {
        const bool line = i % 2 == 0;
        const Vec3 u = random.direction(), v = random.direction();
        std::vector<Triangle> triangles;
        for (int k = 0; k < random.integer(1, 60); ++k) {
            Triangle t;
            for (Vec3& p : t)
                p = random.uniform(-1, 1) * u + (line ? 0.0 : random.uniform(-1, 1)) * v;
            triangles.push_back(t);
        }
        const Obb box = Obb::fit(triangles);
        EXPECT_LT(*std::min_element(box.half.begin(), box.half.end()), 1e-6);
        EXPECT_LT(Rss::fit(triangles).radius, 1e-6);
        if (line) {
            EXPECT_LT(Lss::fit(triangles).radius, 1e-6);
        }
    }
}

} // namespace
} // namespace abut::test
