// Cases worked by hand: how deep, where, and a separating motion that works.

#include <abut/error.h>
#include <abut/penetration.h>

#include "tests/support/body.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abut::test {
namespace {

const Mesh kUnitBox = box_mesh({0, 0, 0}, {1, 1, 1});

void expect_near(const Vec3& v, const Vec3& w, double tolerance) {
    EXPECT_NEAR(v.x, w.x, tolerance);
    EXPECT_NEAR(v.y, w.y, tolerance);
    EXPECT_NEAR(v.z, w.z, tolerance);
}

/// Applies the separating motion and asks again.
void expect_separated(const Mesh& a, const Mesh& b, const Depth& depth) {
    const Transform moved = translation(depth.separation.x, depth.separation.y, depth.separation.z);
    EXPECT_FALSE(collide(Model(a), {}, Model(b), moved).meet());
    const Depth after = penetration(Model(a), {}, Model(b), moved);
    EXPECT_FALSE(after.interpenetrate);
    EXPECT_TRUE(after.regions.empty());
    EXPECT_EQ(after.separation, Vec3{});
    // For locked models, whose regions have no depth, the depth is also a translation's length.
    const bool locked = std::all_of(depth.regions.begin(), depth.regions.end(),
                                    [](const ContactRegion& r) { return r.depth == 0; });
    EXPECT_LE(depth.depth, length(depth.separation) * (locked ? 1.01 : 1));
}

Depth ask(const Mesh& a, const Mesh& b) {
    Depth depth = penetration(Model(a), {}, Model(b), {});
    if (!depth.regions.empty())
        expect_separated(a, b, depth);
    else
        EXPECT_EQ(depth.separation, Vec3{});
    for (const ContactRegion& r : depth.regions) {
        EXPECT_LE(r.depth, depth.depth);
        EXPECT_LE(r.depth, r.depth_at_most);
        EXPECT_TRUE(std::is_sorted(r.pairs.begin(), r.pairs.end()));
        const bool open = !examine_solid(a).solid && !examine_solid(b).solid;
        EXPECT_NEAR(length(r.point_a - r.point_b), open ? 0 : r.depth, 1e-9 * r.depth + 1e-15);
        EXPECT_EQ(r.touching, depth.interpenetrate ? r.touching : true);
    }
    return depth;
}

TEST(Penetration, OneBoxIntoTheFaceOfAnother) {
    const Depth d = ask(kUnitBox, box_mesh({0.9, 0.3, 0.2}, {2, 0.7, 0.6}));
    EXPECT_TRUE(d.interpenetrate);
    ASSERT_EQ(d.regions.size(), 1U);
    EXPECT_NEAR(d.depth, 0.1, 1e-3);
    EXPECT_GE(d.depth_at_most, 0.1 - 1e-12);
    expect_near(d.direction, {1, 0, 0}, 1e-12);
    EXPECT_EQ(d.point_a.x, 1);
    EXPECT_EQ(d.point_b.x, 0.9);
    EXPECT_NEAR(d.regions[0].area, 0.16, 1e-12); // the section of b in a's face
    expect_near(d.regions[0].normal, {1, 0, 0}, 1e-12);
    EXPECT_NEAR(length(d.separation), 0.1, 0.1 / 128);
    expect_near(normalized_or_zero(d.separation), {1, 0, 0}, 1e-6);
}

TEST(Penetration, NormalsPointFromAToB) {
    for (const Mesh& a : {kUnitBox, reversed(kUnitBox)})
        for (const Mesh& b : {box_mesh({0.3, 0.2, -1}, {0.7, 0.6, 0.1}),
                              reversed(box_mesh({0.3, 0.2, -1}, {0.7, 0.6, 0.1}))}) {
            const Depth d = ask(a, b), e = ask(b, a);
            ASSERT_EQ(d.regions.size(), 1U);
            ASSERT_EQ(e.regions.size(), 1U);
            expect_near(d.regions[0].normal, {0, 0, -1}, 1e-12);
            expect_near(e.regions[0].normal, {0, 0, 1}, 1e-12);
            EXPECT_NEAR(e.regions[0].area, 0.16, 1e-12);
            EXPECT_NEAR(d.depth, e.depth, 1e-3);
        }
}

TEST(Penetration, ABallDippedIntoABlock) {
    const Mesh ball = sphere_mesh(1, 64, 33), block = box_mesh({-3, -3, -3}, {3, 3, -0.8});
    const Depth d = ask(block, ball);
    ASSERT_EQ(d.regions.size(), 1U);
    EXPECT_NEAR(d.regions[0].area, std::numbers::pi * 0.36, 0.01); // a circle of radius 0.6
    expect_near(d.regions[0].normal, {0, 0, 1}, 1e-12);
    EXPECT_NEAR(d.depth, 0.2, 2e-3);
    expect_near(d.direction, {0, 0, 1}, 1e-9);
}

TEST(Penetration, CornerInCorner) {
    const Depth d = ask(kUnitBox, box_mesh({0.9, 0.8, 0.7}, {2, 2, 2}));
    ASSERT_EQ(d.regions.size(), 1U);
    EXPECT_NEAR(d.depth, 0.1, 1e-3);
    EXPECT_NEAR(length(d.separation), 0.1, 0.1 / 128);
    // The contact curve runs over three faces of a: 0.2 x 0.3, 0.1 x 0.3, 0.1 x 0.2.
    EXPECT_NEAR(d.regions[0].area, length({0.06, 0.03, 0.02}), 1e-12);
}

TEST(Penetration, ContainedWithoutContact) {
    const Mesh inner = box_mesh({0.5, 0.4, 0.4}, {0.7, 0.6, 0.6});
    for (const bool swap : {false, true}) {
        const Depth d = swap ? ask(inner, kUnitBox) : ask(kUnitBox, inner);
        EXPECT_TRUE(d.interpenetrate);
        ASSERT_EQ(d.regions.size(), 1U);
        EXPECT_TRUE(d.regions[0].pairs.empty());
        EXPECT_FALSE(d.regions[0].touching);
        EXPECT_EQ(d.regions[0].area, 0);
        // The centre of the face x = 0.5 is 0.5 away from the top, bottom, front, back and left
        // faces.
        EXPECT_NEAR(d.depth, 0.5, 0.006);
        EXPECT_NEAR(length(d.separation), 0.5, 0.5 / 64); // leaves at x = 1
        EXPECT_GT(swap ? -d.separation.x : d.separation.x, 0.49);
    }
}

/// The prongs of a U end in a bar. There are two regions, each with its own depth.
TEST(Penetration, AUMeetsABarTwice) {
    const Mesh bar = box_mesh({0, 0, 0}, {10, 1, 1});
    // The U is extruded along z. These are its points in x and y.
    const std::vector<Vec3> outline{{1, 0.8, 0}, {2, 0.8, 0}, {2, 3, 0}, {8, 3, 0},
                                    {8, 0.9, 0}, {9, 0.9, 0}, {9, 4, 0}, {1, 4, 0}};
    const std::vector<std::array<std::uint32_t, 3>> front{{0, 1, 2}, {0, 2, 7}, {2, 6, 7},
                                                          {2, 3, 6}, {3, 4, 6}, {4, 5, 6}};
    Mesh u;
    for (const double z : {0.25, 0.75})
        for (const Vec3& p : outline)
            u.positions.push_back({p.x, p.y, z});
    for (const auto& t : front) {
        u.triangles.push_back({t[0], t[2], t[1]});
        u.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t j = (i + 1) % 8;
        u.triangles.push_back({i, j, j + 8});
        u.triangles.push_back({i, j + 8, i + 8});
    }
    ASSERT_EQ(examine_solid(u).outward, 1);
    for (const bool swap : {false, true}) {
        const Depth d = swap ? ask(u, bar) : ask(bar, u);
        ASSERT_EQ(d.regions.size(), 2U);
        const bool left_first = d.regions[0].point_a.x < 5;
        const ContactRegion &left = d.regions[left_first ? 0 : 1],
                            &right = d.regions[left_first ? 1 : 0];
        EXPECT_NEAR(left.depth, 0.2, 2e-3);
        EXPECT_NEAR(right.depth, 0.1, 1e-3);
        EXPECT_LT(left.point_b.x, 2.01);
        EXPECT_GT(right.point_b.x, 7.99);
        EXPECT_NEAR(left.area, 0.5, 1e-12);
        EXPECT_NEAR(right.area, 0.5, 1e-12);
        expect_near(left.normal, {0, swap ? -1.0 : 1.0, 0}, 1e-12);
        EXPECT_EQ(d.depth, left.depth);
        EXPECT_NEAR(length(d.separation), 0.2, 0.2 / 128);
    }
}

TEST(Penetration, ABarRightThroughAWallHasTwoCurves) {
    const Mesh wall = box_mesh({-3, -3, 0}, {3, 3, 1}),
               bar = box_mesh({-0.2, -0.3, -2}, {0.2, 0.3, 3});
    const Depth d = ask(wall, bar);
    ASSERT_EQ(d.regions.size(), 2U);
    for (const ContactRegion& r : d.regions) {
        EXPECT_NEAR(r.area, 0.24, 1e-12);
        EXPECT_NEAR(std::abs(r.normal.z), 1, 1e-12);
        EXPECT_NEAR(r.depth, 0.5, 6e-3); // half the wall, reached on the bar
    }
    EXPECT_EQ(d.regions[0].normal.z, -d.regions[1].normal.z);
    EXPECT_NEAR(length(d.separation), 3, 3.0 / 128); // leaves through the nearer end
}

TEST(Penetration, TouchingOnly) {
    const Depth face = ask(kUnitBox, box_mesh({0.2, 0.2, 1}, {0.8, 0.6, 2}));
    EXPECT_TRUE(face.meet);
    EXPECT_FALSE(face.interpenetrate);
    EXPECT_EQ(face.depth, 0);
    EXPECT_EQ(face.status, Status::exact);
    ASSERT_EQ(face.regions.size(), 1U);
    EXPECT_TRUE(face.regions[0].touching);
    EXPECT_NEAR(face.regions[0].area, 0.24, 1e-14);
    expect_near(face.regions[0].normal, {0, 0, 1}, 1e-12);
    EXPECT_LT(length(face.separation), 1e-6);

    const Depth corner = ask(kUnitBox, box_mesh({1, 1, 1}, {2, 2, 2}));
    EXPECT_FALSE(corner.interpenetrate);
    ASSERT_EQ(corner.regions.size(), 1U);
    EXPECT_EQ(corner.regions[0].area, 0);
    EXPECT_EQ(corner.regions[0].normal, Vec3{});
    EXPECT_EQ(corner.regions[0].point_a, (Vec3{1, 1, 1}));

    const Mesh two_feet =
        joined(box_mesh({0, 0, 1}, {0.2, 1, 2}), box_mesh({0.8, 0, 1}, {1, 1, 2}));
    EXPECT_EQ(ask(kUnitBox, two_feet).regions.size(), 2U);
}

TEST(Penetration, ApartIsNothing) {
    const Depth d = ask(kUnitBox, box_mesh({2, 0, 0}, {3, 1, 1}));
    EXPECT_FALSE(d.meet);
    EXPECT_FALSE(d.interpenetrate);
    EXPECT_TRUE(d.regions.empty());
    EXPECT_EQ(d.depth, 0);
    EXPECT_EQ(d.status, Status::exact);
    const Depth none = ask(kUnitBox, Mesh{});
    EXPECT_FALSE(none.interpenetrate);
    EXPECT_TRUE(none.regions.empty());
}

/// In the cavity of a hollow box: inside its hull, but outside its walls.
TEST(Penetration, InACavityIsApart) {
    const Mesh hollow =
        joined(box_mesh({-2, -2, -2}, {3, 3, 3}), reversed(box_mesh({-1, -1, -1}, {2, 2, 2})));
    EXPECT_FALSE(ask(hollow, kUnitBox).interpenetrate);
    EXPECT_FALSE(ask(kUnitBox, hollow).interpenetrate);
    const Depth d = ask(hollow, box_mesh({0, 0, 0}, {2.5, 1, 1}));
    EXPECT_TRUE(d.interpenetrate);
    EXPECT_NEAR(d.depth, 0.5, 6e-3);
}

/// A component inside counts in addition to one that crosses.
TEST(Penetration, AComponentInsideBesideOneThatCrosses) {
    const Mesh b = joined(box_mesh({0.9, 0.3, 0.2}, {2, 0.7, 0.6}),
                          box_mesh({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
    const Depth d = ask(kUnitBox, b);
    ASSERT_EQ(d.regions.size(), 2U);
    EXPECT_NEAR(d.regions[0].depth, 0.1, 1e-3);
    EXPECT_TRUE(d.regions[1].pairs.empty());
    EXPECT_NEAR(d.regions[1].depth, 0.4, 5e-3);
    EXPECT_EQ(d.depth, d.regions[1].depth);
    const Depth swapped = ask(b, kUnitBox);
    ASSERT_EQ(swapped.regions.size(), 2U);
    EXPECT_NEAR(swapped.regions[0].depth, 0.1, 1e-3);
}

TEST(Penetration, TheSameSolidTwice) {
    for (const Mesh& other : {kUnitBox, reversed(kUnitBox)}) {
        const Depth d = ask(kUnitBox, other);
        EXPECT_TRUE(d.interpenetrate);
        EXPECT_NEAR(d.depth, 1, 1e-6); // no point of one surface lies inside the other
        EXPECT_EQ(d.regions[0].depth, 0);
        EXPECT_NEAR(length(d.separation), 1, 1.0 / 128);
    }
    const Mesh ball = sphere_mesh(1, 16, 9);
    EXPECT_TRUE(ask(ball, ball).interpenetrate);
}

TEST(Penetration, AlignedSectionsShareNothingButFaces) {
    const Depth d = ask(kUnitBox, box_mesh({0.75, 0, 0}, {1.75, 1, 1}));
    EXPECT_TRUE(d.interpenetrate);
    EXPECT_NEAR(d.depth, 0.25, 3e-3);
    EXPECT_NEAR(length(d.separation), 0.25, 0.25 / 128);
}

TEST(Penetration, OpenSheets) {
    const Mesh floor{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const Mesh wall{{{0.3, -0.5, -0.2}, {0.3, 0.5, -0.2}, {0.3, 0.5, 1}, {0.3, -0.5, 1}},
                    {{0, 1, 2}, {0, 2, 3}}};
    const Depth d = ask(floor, wall);
    EXPECT_TRUE(d.interpenetrate);
    ASSERT_EQ(d.regions.size(), 1U);
    EXPECT_NEAR(d.depth, 0.2, 1e-12);         // depth of the triangles
    EXPECT_NEAR(d.regions[0].area, 0, 1e-12); // a straight line encloses no area
    EXPECT_NEAR(length(d.separation), 0.2, 0.2 / 128);
    // An open surface in a solid: the depth is how far it reaches in.
    const Depth in = ask(box_mesh({0, -2, 0}, {2, 2, 2}), floor);
    EXPECT_TRUE(in.interpenetrate || in.regions[0].touching);
    const Depth deep = ask(box_mesh({0.5, -2, -1}, {2, 2, 1}), floor);
    EXPECT_TRUE(deep.interpenetrate);
    EXPECT_NEAR(deep.depth, 0.5, 6e-3);
}

TEST(Penetration, ScalesAndFarFromTheOrigin) {
    for (const double scale : {1e-6, 1e6})
        for (const double far : {0.0, 1e3}) {
            const Transform place({scale, 0, 0, 0, scale, 0, 0, 0, scale, far * scale, 0, 0});
            const Depth d = ask(transformed(kUnitBox, place),
                                transformed(box_mesh({0.9, 0.3, 0.2}, {2, 0.7, 0.6}), place));
            EXPECT_NEAR(d.depth / scale, 0.1, 1e-3);
            EXPECT_NEAR(d.regions[0].area / scale / scale, 0.16, 1e-8);
            EXPECT_NEAR(length(d.separation) / scale, 0.1, 0.1 / 128);
        }
}

TEST(Penetration, FlattenedAndMirrored) {
    const Model box(kUnitBox);
    const Depth flat = penetration(box, scaling(1, 1, 0), box, translation(0.1, 0.1, -0.5));
    EXPECT_TRUE(flat.interpenetrate);
    EXPECT_GT(length(flat.separation), 0);
    const Depth mirrored = penetration(box, scaling(-1, 1, 1), box, translation(-0.1, 0.3, 0.2));
    EXPECT_NEAR(mirrored.depth, 0.1, 1e-3);
    ASSERT_EQ(mirrored.regions.size(), 1U);
    expect_near(mirrored.direction, {1, 0, 0}, 1e-12);
    EXPECT_GT(mirrored.regions[0].normal.x, 0.5);
}

TEST(Penetration, BadArgumentsAreErrors) {
    const Model box(kUnitBox);
    Transform bad;
    bad.m[4] = std::numeric_limits<double>::quiet_NaN();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)penetration(box, bad, box, {}), Error);
    EXPECT_THROW((void)penetration(box, {}, box, bad), Error);
    EXPECT_THROW((void)penetration(box, {}, box, {}, {.relative_error = -0.1}), Error);
    EXPECT_THROW((void)penetration(box, {}, box, {}, {.relative_error = nan}), Error);
    const Depth quick =
        penetration(box, {}, box, translation(0.9, 0.1, 0.2), {.separation = false});
    EXPECT_EQ(quick.separation, Vec3{});
    EXPECT_GT(quick.depth, 0.09);
}

} // namespace
} // namespace abut::test
