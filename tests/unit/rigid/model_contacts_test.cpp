#include <abut/error.h>
#include <abut/model_contacts.h>

#include "math/vector.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

using namespace abut;
using namespace abut::test;

namespace {

Model block(const Vec3& half) {
    return Model(box_mesh(-half, half));
}
Model ground() {
    return Model(box_mesh({-10, -10, -1}, {10, 10, 0}));
}

void expect_near(const Vec3& p, const Vec3& q, double error = 1e-12) {
    EXPECT_NEAR(p.x, q.x, error);
    EXPECT_NEAR(p.y, q.y, error);
    EXPECT_NEAR(p.z, q.z, error);
}

/// The depths are those of the points along the normal, the deepest first; names differ.
void expect_consistent(const ModelManifold& m, double error = 1e-12) {
    ASSERT_GE(m.count, 1U);
    ASSERT_LE(m.count, 4U);
    EXPECT_NEAR(length(m.normal), 1, 1e-12);
    std::set<std::uint64_t> names;
    for (std::uint32_t i = 0; i < m.count; ++i) {
        const ContactPoint& p = m.points[i];
        EXPECT_NEAR(dot(m.normal, p.point_a - p.point_b), p.depth, error);
        EXPECT_LE(p.depth, m.points[0].depth);
        names.insert(p.feature);
    }
    EXPECT_EQ(names.size(), m.count);
}

/// Four points with this depth, at the corners of a square in x and y.
void expect_square(const ModelManifold& m, const Vec3& middle, double half, double depth) {
    expect_consistent(m);
    ASSERT_EQ(m.count, 4U);
    std::set<std::pair<bool, bool>> corners;
    for (const ContactPoint& p : m.points) {
        EXPECT_NEAR(p.depth, depth, 1e-12);
        EXPECT_NEAR(std::abs(p.point_b.x - middle.x), half, 1e-12);
        EXPECT_NEAR(std::abs(p.point_b.y - middle.y), half, 1e-12);
        corners.emplace(p.point_b.x > middle.x, p.point_b.y > middle.y);
    }
    EXPECT_EQ(corners.size(), 4U);
}

} // namespace

TEST(ModelContacts, BoxInGroundHasItsFourCorners) {
    const Transform place = translation(0.3, 0.2, 0.9);
    const auto manifolds = contact_manifolds(ground(), {}, block({1, 1, 1}), place);
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1});
    EXPECT_EQ(manifolds[0].status, Status::exact);
    expect_square(manifolds[0], {0.3, 0.2, 0}, 1, 0.1);
    const auto swapped = contact_manifolds(block({1, 1, 1}), place, ground(), {});
    ASSERT_EQ(swapped.size(), 1U);
    expect_near(swapped[0].normal, {0, 0, -1});
    expect_square(swapped[0], {0.3, 0.2, 0}, 1, 0.1);
}

TEST(ModelContacts, BoxOnGroundTouchesWithFourCorners) {
    const auto manifolds =
        contact_manifolds(ground(), {}, block({1, 1, 1}), translation(0.25, 0.5, 1));
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1});
    expect_square(manifolds[0], {0.25, 0.5, 0}, 1, 0);
}

TEST(ModelContacts, BoxOverGroundHasGapsWithinTheMargin) {
    const Model box = block({1, 1, 1});
    const Transform place = translation(0.3, 0.2, 1.0625);
    EXPECT_TRUE(contact_manifolds(ground(), {}, box, place).empty());
    EXPECT_TRUE(contact_manifolds(ground(), {}, box, place, {.margin = 0.05}).empty());
    const auto manifolds = contact_manifolds(ground(), {}, box, place, {.margin = 0.1});
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1});
    expect_square(manifolds[0], {0.3, 0.2, 0}, 1, -0.0625);
}

TEST(ModelContacts, GapAsLargeAsTheMarginHasTheDirectionOfTheGap) {
    const auto manifolds = contact_manifolds(ground(), {}, block({1, 1, 1}),
                                             translation(8, 8, 1.0625), {.margin = 0.0625});
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1});
    expect_square(manifolds[0], {8, 8, 0}, 1, -0.0625);
}

TEST(ModelContacts, EqualBoxesStackedTooDeepPartUpwards) {
    const Model cube = block({1, 1, 1});
    const auto manifolds = contact_manifolds(cube, {}, cube, translation(0, 0, 1.99));
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1}, 1e-9);
    expect_consistent(manifolds[0], 1e-9);
    EXPECT_EQ(manifolds[0].status, Status::bound_only);
    // One near each corner, so that they carry the upper box.
    ASSERT_EQ(manifolds[0].count, 4U);
    std::set<std::pair<bool, bool>> corners;
    for (const ContactPoint& p : manifolds[0].points) {
        EXPECT_NEAR(p.depth, 0.01, 1e-9);
        EXPECT_GT(std::min(std::abs(p.point_a.x), std::abs(p.point_a.y)), 0.9);
        corners.emplace(p.point_a.x > 0, p.point_a.y > 0);
    }
    EXPECT_EQ(corners.size(), 4U);
}

TEST(ModelContacts, EqualBoxesStackedInATiltedFramePartAlongTheStack) {
    const Model cube = block({1, 1, 1});
    for (int degrees = 1; degrees < 90; ++degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        const double c = std::cos(angle / 2), s = std::sin(angle / 2);
        const Vec3 up{0, -std::sin(angle), std::cos(angle)};
        for (const double sunk : {0.01, 0.1}) {
            const auto manifolds = contact_manifolds(cube, Pose{{}, {c, s, 0, 0}}, cube,
                                                     Pose{(2 - sunk) * up, {c, s, 0, 0}});
            ASSERT_EQ(manifolds.size(), 1U) << degrees;
            expect_near(manifolds[0].normal, up, 1e-3);
            expect_consistent(manifolds[0], 1e-9);
            EXPECT_NEAR(manifolds[0].points[0].depth, sunk, 0.1 * sunk) << degrees;
            EXPECT_GE(manifolds[0].count, 3U) << degrees << " " << sunk;
        }
    }
}

TEST(ModelContacts, VertexOnFaceIsOnePoint) {
    // A corner points straight down.
    const double third = std::acos(1 / std::sqrt(3.0));
    const Vec3 axis = (std::sin(third / 2) / std::sqrt(2.0)) * Vec3{1, -1, 0};
    const Pose tilted{{0, 0, std::sqrt(3.0) - 0.01}, {std::cos(third / 2), axis.x, axis.y, axis.z}};
    const auto manifolds = contact_manifolds(ground(), {}, block({1, 1, 1}), tilted);
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1});
    expect_consistent(manifolds[0]);
    EXPECT_NEAR(manifolds[0].points[0].depth, 0.01, 1e-12);
    expect_near(manifolds[0].points[0].point_a, {0, 0, 0});
}

TEST(ModelContacts, CrossedEdgesPartAlongBothEdges) {
    // Two bars with a square section, each standing on an edge, one across the other.
    const double s = std::sqrt(0.5);
    const double c = std::cos(std::numbers::pi / 8), d = std::sin(std::numbers::pi / 8);
    const Transform turned_x = Pose{{}, {c, d, 0, 0}};
    const Transform turned_y = Pose{{0, 0, 4 * s - 0.02}, {c, 0, d, 0}};
    const auto manifolds =
        contact_manifolds(block({5, 1, 1}), turned_x, block({1, 5, 1}), turned_y);
    ASSERT_EQ(manifolds.size(), 1U);
    expect_near(manifolds[0].normal, {0, 0, 1}, 1e-9);
    expect_consistent(manifolds[0]);
    EXPECT_NEAR(manifolds[0].points[0].depth, 0.02, 1e-9);
}

TEST(ModelContacts, BallInACornerHasAManifoldForEachWall) {
    const Model corner(cells_mesh(3, [](int x, int y, int z) { return x * y * z == 0; }));
    const Model ball(sphere_mesh(1, 40, 20));
    for (const double sunk : {0.03, 0.3}) {
        const auto manifolds =
            contact_manifolds(corner, {}, ball, translation(2 - sunk, 2 - sunk, 2 - sunk));
        ASSERT_EQ(manifolds.size(), 3U) << sunk;
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            EXPECT_TRUE(std::any_of(manifolds.begin(), manifolds.end(), [&](const auto& m) {
                return dot(m.normal, axis) > 0.98 &&
                       std::abs(m.points[0].depth - sunk) < 0.1 * sunk;
            })) << sunk;
        for (const ModelManifold& m : manifolds)
            expect_consistent(m);
    }
}

TEST(ModelContacts, LinkedRingsHaveARegionAtEachPlace) {
    const Model ring(torus_mesh(1, 0.3, 40, 20));
    const Transform across = Pose{{1.5, 0, 0}, {std::sqrt(0.5), std::sqrt(0.5), 0, 0}};
    // The second ring passes through the hole and just meets the first one's inner side.
    const auto manifolds = contact_manifolds(ring, {}, ring, across);
    ASSERT_FALSE(manifolds.empty());
    for (const ModelManifold& m : manifolds) {
        expect_consistent(m);
        EXPECT_GT(m.points[0].depth, 0);
    }
    const auto two = contact_manifolds(ring, {}, ring, translation(2.3, 0, 0.05));
    EXPECT_GE(two.size(), 1U);
    const auto flat = contact_manifolds(ring, {}, ring, translation(1.2, 0, 0.4));
    EXPECT_EQ(flat.size(), 2U);
}

TEST(ModelContacts, BarThroughAWallIsDeepOnBothSides) {
    const Model wall(box_mesh({-5, -5, 0}, {5, 5, 0.125})), bar = block({0.25, 0.25, 3});
    const auto manifolds = contact_manifolds(wall, {}, bar, translation(0.5, 0.25, 0.5));
    ASSERT_EQ(manifolds.size(), 2U);
    EXPECT_NEAR(manifolds[0].normal.z * manifolds[1].normal.z, -1, 1e-12);
    for (const ModelManifold& m : manifolds) {
        expect_consistent(m);
        EXPECT_GE(m.points[0].depth, 0.125);
    }
}

TEST(ModelContacts, SolidInsideHasTheDepthOfPenetration) {
    const auto manifolds =
        contact_manifolds(ground(), {}, block({0.1, 0.1, 0.1}), translation(0.3, 0.2, -0.3));
    ASSERT_EQ(manifolds.size(), 1U);
    EXPECT_NEAR(manifolds[0].points[0].depth, 0.4, 0.01);
    expect_near(manifolds[0].normal, {0, 0, 1}, 1e-9);
    EXPECT_EQ(manifolds[0].status, Status::bound_only);
}

TEST(ModelContacts, OpenSheetIsPushedFromItsSide) {
    Mesh sheet;
    sheet.positions = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (const bool reverse : {false, true}) {
        const auto manifolds = contact_manifolds(Model(reverse ? reversed(sheet) : sheet), {},
                                                 block({1, 1, 1}), translation(0.3, 0.2, 0.9));
        ASSERT_EQ(manifolds.size(), 1U);
        expect_near(manifolds[0].normal, {0, 0, 1});
        expect_square(manifolds[0], {0.3, 0.2, 0}, 1, 0.1);
    }
}

TEST(ModelContacts, FarFromTheOriginIsTheSame) {
    const double far = 0x1p20;
    const Transform here = translation(0.25, 0.5, 0.875);
    const auto near_by = contact_manifolds(ground(), {}, block({1, 1, 1}), here);
    const auto away = contact_manifolds(ground(), translation(far, far, far), block({1, 1, 1}),
                                        translation(far + 0.25, far + 0.5, far + 0.875));
    ASSERT_EQ(near_by.size(), 1U);
    ASSERT_EQ(away.size(), 1U);
    ASSERT_EQ(away[0].count, near_by[0].count);
    EXPECT_EQ(away[0].normal, near_by[0].normal);
    for (std::uint32_t i = 0; i < away[0].count; ++i) {
        EXPECT_EQ(away[0].points[i].feature, near_by[0].points[i].feature);
        EXPECT_NEAR(away[0].points[i].depth, near_by[0].points[i].depth, 1e-9);
    }
}

TEST(ModelContacts, DegenerateInput) {
    const Model box = block({1, 1, 1}), empty{Mesh{}};
    EXPECT_TRUE(contact_manifolds(empty, {}, box, {}).empty());
    EXPECT_TRUE(contact_manifolds(box, {}, empty, {}, {.margin = 1}).empty());
    Mesh needles; // a segment and a point
    needles.positions = {{-2, 0, 0}, {2, 0, 0}, {0.5, 0.5, 1}};
    needles.triangles = {{0, 1, 0}, {2, 2, 2}};
    for (const double margin : {0.0, 0.25})
        for (const ModelManifold& m :
             contact_manifolds(Model(needles), {}, box, {}, {.margin = margin}))
            expect_consistent(m);
    // Coincident boxes, and one that is flattened into the other's face.
    for (const ModelManifold& m : contact_manifolds(box, {}, box, {}))
        expect_consistent(m);
    for (const ModelManifold& m : contact_manifolds(box, {}, box, scaling(1, 1, 0)))
        expect_consistent(m);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double margin : {-1.0, nan, std::numeric_limits<double>::infinity()})
        EXPECT_THROW(contact_manifolds(box, {}, box, {}, {.margin = margin}), Error);
    EXPECT_THROW(contact_manifolds(box, {}, box, translation(nan, 0, 0)), Error);
}

TEST(ModelContacts, RegionsKeepTheirNames) {
    const Model ring(torus_mesh(1, 0.3, 40, 20));
    std::vector<ModelManifold> last = contact_manifolds(ring, {}, ring, translation(1.2, 0, 0.4));
    ASSERT_EQ(last.size(), 2U);
    for (int step = 1; step <= 50; ++step) {
        const auto now =
            contact_manifolds(ring, {}, ring, translation(1.2, 0.002 * step, 0.4), {.last = &last});
        ASSERT_EQ(now.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(now[i].region, last[i].region);
            EXPECT_LT(length(now[i].points[0].point_a - last[i].points[0].point_a), 0.2);
        }
        last = now;
    }
}
