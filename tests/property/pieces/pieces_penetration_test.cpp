// Penetration of solids as unions of convex pieces, against each pair of pieces and against
// translations of the triangles. Batches of queries of pieces.

#include <abut/batch.h>
#include <abut/convex_pieces.h>
#include <abut/error.h>

#include "tests/support/rounds.h"
#include "tests/support/solids.h"
#include "tests/support/two_solids.h"

#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

/// The largest depth over all pairs of pieces.
double deepest_pair(const ConvexPieces& a, const Transform& world_a, const ConvexPieces& b,
                    const Transform& world_b) {
    double deepest = 0;
    std::vector<Convex> hulls_b;
    for (std::size_t j = 0; j < b.size(); ++j)
        hulls_b.push_back(b.hull(j));
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Convex hull_a = a.hull(i);
        for (const Convex& hull_b : hulls_b)
            deepest = std::max(deepest, penetration(hull_a, world_a, hull_b, world_b).depth);
    }
    return deepest;
}

TwoSolids moved(const TwoSolids& s, const Vec3& by) {
    return {s.a, s.b, s.world_a, translated(s.world_b, by)};
}

TEST(PiecesPenetration, BoundsEverySeparatingMotionAndFindsOne) {
    Random random(8120);
    int meet = 0, apart = 0, shorter = 0, close = 0;
    for (int i = 0; i < many(30); ++i) {
        const Model a(make_solid(random, random.integer(0, kSolidKinds - 1))),
            b(make_solid(random, random.integer(0, kSolidKinds - 1)));
        const ConvexPieces pieces_a(a), pieces_b(b);
        const Vec3 off = random.uniform(0, 3) * random.direction();
        const TwoSolids s{a, b, random.pose(0),
                          compose(translation(off.x, off.y, off.z), random.pose(0))};
        const PiecesDepth found = penetration(pieces_a, s.world_a, pieces_b, s.world_b);
        if (!found.meet) {
            ++apart;
            EXPECT_FALSE(share_a_point(s)) << i;
            EXPECT_EQ(found.depth, 0);
            EXPECT_EQ(found.separation, (Vec3{}));
            continue;
        }
        ++meet;
        EXPECT_TRUE(share_a_point(s)) << i;
        EXPECT_NEAR(found.depth, deepest_pair(pieces_a, s.world_a, pieces_b, s.world_b), 1e-9) << i;
        EXPECT_FALSE(share_a_point(moved(s, found.separation))) << i;
        EXPECT_GE(length(found.separation), found.depth * (1 - 1e-9)) << i;
        close += length(found.separation) < 2 * found.depth ? 1 : 0;
        EXPECT_NEAR(length(found.point_b + found.depth * found.direction - found.point_a), 0, 1e-9);
        for (int k = 0; k < 4; ++k, ++shorter)
            EXPECT_TRUE(share_a_point(
                moved(s, random.uniform(0, 1 - 1e-9) * found.depth * random.direction())))
                << i;
    }
    EXPECT_GE(meet, many(7));
    EXPECT_GE(apart, many(4));
    EXPECT_GE(close, many(3));
    EXPECT_GE(shorter, many(28));
}

TEST(PiecesPenetration, IsExactForConvexSolids) {
    Random random(8121);
    int meet = 0;
    for (int i = 0; i < many(40); ++i) {
        std::vector<Vec3> points(20);
        for (Vec3& p : points)
            p = random.in_cube(1);
        const Model a(box_mesh({-1, -1, -1}, {1, random.uniform(0, 2), 1})),
            b(Convex(points).mesh());
        const Transform pose = random.pose(1);
        const PiecesDepth found = penetration(ConvexPieces(a), {}, ConvexPieces(b), pose);
        const ConvexDepth expected =
            penetration(Convex(a.mesh().positions), {}, Convex(b.mesh().positions), pose);
        ASSERT_EQ(found.meet, expected.meet) << i;
        EXPECT_NEAR(found.depth, expected.depth, 1e-12) << i;
        EXPECT_EQ(found.status, Status::exact) << i;
        if (!found.meet)
            continue;
        ++meet;
        EXPECT_LE(length(found.separation), found.depth * 1.01 + 1e-8) << i;
    }
    EXPECT_GE(meet, many(5));
}

/// No convex piece of the cube reaches its middle, so the small box may have no contact there.
TEST(PiecesPenetration, OneSolidDeepInsideTheOther) {
    const Model cube(pitted_cube_mesh()), small(box_mesh({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const TwoSolids s{cube, small, {}, translation(3.4, 3.5, 3.5)};
    const PiecesDepth found =
        penetration(ConvexPieces(cube), s.world_a, ConvexPieces(small), s.world_b);
    ASSERT_TRUE(found.meet);
    EXPECT_EQ(found.status, Status::bound_only);
    EXPECT_NEAR(found.depth, distance(cube, s.world_a, small, s.world_b).distance, 1e-12);
    EXPECT_GE(length(found.separation), found.depth);
    EXPECT_FALSE(share_a_point(moved(s, found.separation)));
}

TEST(PiecesPenetration, FlattenedSolids) {
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    const ConvexPieces pieces(cube);
    const PiecesDepth found = penetration(pieces, {}, pieces, scaling(1, 1, 0));
    ASSERT_TRUE(found.meet);
    EXPECT_NEAR(found.depth, 1, 1e-12); // the shortest translation is through the top
    EXPECT_FALSE(collide(pieces, {}, pieces, translated(scaling(1, 1, 0), found.separation)).meet);
    EXPECT_THROW(penetration(pieces, {}, pieces, scaling(HUGE_VAL, 1, 1)), Error);
}

TEST(PiecesBatch, EqualsSingleQueries) {
    Random random(8122);
    const ConvexPieces a{Model(make_solid(random, 2))}, b{Model(make_solid(random, 3))};
    std::vector<Placement> placements;
    placements.reserve(static_cast<std::size_t>(many(60)));
    for (int i = 0; i < many(60); ++i)
        placements.push_back({random.pose(1), random.pose(1)});
    PiecesWarmStart warm_start;
    const auto gaps = distance(a, b, placements, {.warm_start = &warm_start});
    const auto contacts = collide(a, b, placements, {.mode = ContactMode::all});
    const auto near = within(a, b, placements, 0.3);
    const auto depths = penetration(a, b, placements);
    int meet = 0, are_near = 0;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const auto& [world_a, world_b] = placements[i];
        const PiecesGap gap = distance(a, world_a, b, world_b);
        ASSERT_EQ(gaps[i].distance, gap.distance);
        ASSERT_EQ(gaps[i].point_a, gap.point_a);
        ASSERT_EQ(gaps[i].triangle_b, gap.triangle_b);
        ASSERT_EQ(contacts[i].pairs,
                  collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs);
        ASSERT_EQ(near[i], within(a, world_a, b, world_b, 0.3));
        const PiecesDepth depth = penetration(a, world_a, b, world_b);
        ASSERT_EQ(depths[i].depth, depth.depth);
        ASSERT_EQ(depths[i].separation, depth.separation);
        meet += depth.meet ? 1 : 0;
        are_near += near[i] ? 1 : 0;
    }
    EXPECT_GE(meet, many(5));
    EXPECT_LT(are_near, many(60));
    placements[7].world_from_b.m[3] = std::nan("");
    try {
        (void)distance(a, b, placements);
        FAIL() << "NaN was let through";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_EQ(std::string(error.what()).rfind("placement 7: ", 0), 0U) << error.what();
    }
}

} // namespace
} // namespace abut::test
