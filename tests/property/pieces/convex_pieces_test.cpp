// Queries of solids as unions of convex pieces, against queries of their triangles.

#include <abut/convex_pieces.h>
#include <abut/shape_queries.h>

#include "pieces/pieces_data.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"
#include "tests/support/two_solids.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Rounding of world coordinates in queries of triangles.
double rounding_at(const Transform& a, const Transform& b) {
    double size = 8;
    for (std::size_t i = 9; i < 12; ++i)
        size += std::abs(b.m[i]) + std::abs(a.m[i]);
    return 0x1p-48 * size;
}

/// Checks one answer against the triangles. Returns whether the solids are apart.
bool check(const TwoSolids& s, const PiecesGap& gap) {
    if (gap.distance == 0) {
        // A distance below rounding is reported as 0.
        const bool meet = share_a_point(s);
        EXPECT_TRUE(meet || distance(s.a, s.world_a, s.b, s.world_b).distance <=
                                rounding_at(s.world_a, s.world_b));
        return false;
    }
    const Gap surfaces = distance(s.a, s.world_a, s.b, s.world_b);
    EXPECT_NEAR(gap.distance, surfaces.distance,
                1e-12 * surfaces.distance + rounding_at(s.world_a, s.world_b));
    EXPECT_FALSE(share_a_point(s));
    EXPECT_NEAR(length(gap.point_b - gap.point_a), gap.distance,
                1e-12 + 64 * rounding_at(s.world_a, s.world_b));
    // The witness points lie on the triangles that are named.
    const auto on = [](const Model& m, const Transform& world, std::uint32_t triangle,
                       const Vec3& point) {
        Mesh one{m.mesh().positions, {m.mesh().triangles[triangle]}};
        return nearest(Model(one), world, point).distance <= 1e-9;
    };
    EXPECT_TRUE(on(s.a, s.world_a, gap.triangle_a, gap.point_a));
    EXPECT_TRUE(on(s.b, s.world_b, gap.triangle_b, gap.point_b));
    return true;
}

TEST(ConvexPiecesDistance, EqualsTheDistanceOfTheTriangles) {
    Random random(8102);
    int apart = 0, meet = 0;
    for (int i = 0; i < many(60); ++i) {
        const Model a(make_solid(random, random.integer(0, kSolidKinds - 1))),
            b(transformed(make_solid(random, random.integer(0, kSolidKinds - 1)),
                          i % 4 == 0 ? scaling(0.1, 0.1, 0.1) : Transform()));
        const ConvexPieces pieces_a(a), pieces_b(b);
        for (int k = 0; k < 8; ++k) {
            const bool rigid = k < 6;
            TwoSolids s{a, b, random.linear_map(!rigid), random.linear_map(!rigid)};
            const Vec3 at = k == 5 ? random.in_cube(1e4) : random.in_cube(2);
            const Vec3 off = random.uniform(0, k == 0 ? 0.3 : 5) * random.direction();
            s.world_a = compose(translation(at.x, at.y, at.z), s.world_a);
            s.world_b = compose(translation(at.x + off.x, at.y + off.y, at.z + off.z), s.world_b);
            if (k == 4) // parallel, on a lattice
                s.world_a = translation(0, 0, 0),
                s.world_b = translation(std::round(off.x * 4) / 4, std::round(off.y * 4) / 4,
                                        std::round(off.z * 4) / 4);
            const PiecesGap gap = distance(pieces_a, s.world_a, pieces_b, s.world_b);
            (check(s, gap) ? apart : meet) += 1;
            const double tolerance = random.uniform(0, 2);
            if (std::abs(tolerance - gap.distance) > 1e-9) {
                EXPECT_EQ(within(pieces_a, s.world_a, pieces_b, s.world_b, tolerance),
                          gap.distance <= tolerance);
            }
            const double error = random.uniform(0, 1);
            const PiecesGap rough =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.absolute_error = error});
            EXPECT_LE(rough.at_least, gap.distance + 1e-12);
            EXPECT_GE(rough.distance, gap.distance - 1e-12);
            EXPECT_LE(rough.distance, gap.distance + error + 1e-12);
        }
        if (testing::Test::HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(apart, many(100));
    EXPECT_GE(meet, many(100));
}

/// No convex piece of the cube reaches its middle.
TEST(ConvexPiecesDistance, OneSolidDeepInsideTheOther) {
    Random random(8107);
    const Model a(pitted_cube_mesh());
    const ConvexPieces pieces_a(a);
    int contained = 0, apart = 0;
    for (int i = 0; i < many(10); ++i) {
        const Model b(transformed(make_solid(random, i), scaling(0.04, 0.04, 0.04)));
        const ConvexPieces pieces_b(b);
        PiecesWarmStart warm_start;
        for (int k = 0; k < 20; ++k) {
            const Transform turn = random.pose(0);
            const Vec3 at = Vec3{3.5, 3.5, 3.5} + random.in_cube(k % 2 == 0 ? 1.5 : 4.5);
            const TwoSolids s{a, b, {}, compose(translation(at.x, at.y, at.z), turn)};
            const PiecesGap gap =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.warm_start = &warm_start});
            apart += check(s, gap) ? 1 : 0;
            contained += collide(pieces_b, s.world_b, pieces_a, s.world_a).contained ? 1 : 0;
            if (gap.distance == 0) {
                EXPECT_TRUE(contains(a, s.world_a, gap.point_a).side != Side::outside ||
                            nearest(a, s.world_a, gap.point_a).distance <= 1e-12);
            }
        }
    }
    EXPECT_GE(contained, many(10));
    EXPECT_GE(apart, many(10));
}

/// Places b next to a, with a tiny gap or a tiny overlap.
TEST(ConvexPiecesDistance, SolidsThatAlmostTouch) {
    Random random(8103);
    int apart = 0, meet = 0;
    for (int i = 0; i < many(60); ++i) {
        const Model a(make_solid(random, i)),
            b(make_solid(random, random.integer(0, kSolidKinds - 1)));
        const ConvexPieces pieces_a(a), pieces_b(b);
        TwoSolids s{a, b, random.pose(0), random.pose(0)};
        const Vec3 direction = random.direction();
        const Transform turn = s.world_b;
        double offset = 8;
        const auto place = [&](double by) {
            const Vec3 d = by * direction;
            s.world_b = compose(translation(d.x, d.y, d.z), turn);
        };
        for (int step = 0; step < 100; ++step) {
            place(offset);
            const double gap = distance(a, s.world_a, b, s.world_b).distance;
            offset -= gap;
            if (gap < 1e-9 || offset < 0)
                break;
        }
        if (offset < 0)
            continue; // b passes through the hole of a
        for (const double by : {1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-6, -1e-3}) {
            place(offset + by);
            (check(s, distance(pieces_a, s.world_a, pieces_b, s.world_b)) ? apart : meet) += 1;
        }
    }
    EXPECT_GE(apart, many(100));
    EXPECT_GE(meet, many(60));
}

class ConvexPiecesPath : public testing::TestWithParam<bool> {};

TEST_P(ConvexPiecesPath, AWarmStartChangesNoAnswer) {
    const bool both_move = GetParam();
    Random random(8104 + (both_move ? 1 : 0));
    int apart = 0, meet = 0, few = 0;
    for (int i = 0; i < many(30); ++i) {
        const Model a(make_solid(random, random.integer(0, kSolidKinds - 1))),
            b(transformed(make_solid(random, random.integer(0, kSolidKinds - 1)),
                          i % 5 == 0 ? scaling(0.1, 0.1, 0.1) : Transform()));
        const ConvexPieces pieces_a(a), pieces_b(b);
        PiecesWarmStart warm_start;
        const Vec3 axis = random.direction(), across = random.direction();
        const double from = random.uniform(-6, -2), step = random.uniform(0.01, 0.1);
        const bool affine = i % 7 == 0;
        const Transform shape = affine ? random.linear_map(true) : Transform();
        for (int k = 0; k < 100; ++k) {
            const double angle = 0.02 * k;
            const auto turned = [&](double by, const Vec3& at) {
                const Vec3 v = std::sin(by) * axis;
                return Transform(Pose{at, {std::cos(by), v.x, v.y, v.z}});
            };
            const Vec3 at = (from + step * k) * across + Vec3{0, 0, 0.5};
            TwoSolids s{a, b, both_move ? turned(-angle, {3 * std::sin(angle), 0, 0}) : Transform(),
                        compose(turned(angle, at), shape)};
            if (k % 40 == 39)
                s.world_b = random.pose(3);
            const PiecesGap warm =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.warm_start = &warm_start});
            const PiecesGap cold = distance(pieces_a, s.world_a, pieces_b, s.world_b);
            (warm.distance > 0 ? apart : meet) += 1;
            few += warm.counters.hull_pairs <= 2 ? 1 : 0;
            ASSERT_NEAR(warm.distance, cold.distance,
                        1e-12 * cold.distance + rounding_at(s.world_a, s.world_b))
                << i << ' ' << k << " surfaces " << distance(a, s.world_a, b, s.world_b).distance
                << " warm " << warm.piece_a << " " << warm.piece_b << " cold " << cold.piece_a
                << " " << cold.piece_b << " sizes " << pieces_a.size() << " " << pieces_b.size()
                << " hulls "
                << distance(pieces_a.hull(warm.piece_a), s.world_a, pieces_b.hull(warm.piece_b),
                            s.world_b)
                       .distance
                << " " << warm.counters.hull_pairs << " f " << int(warm.feature_a) << " "
                << int(warm.feature_b) << " simp " << warm.counters.simplices;
            if (k % 10 == 0) {
                check(s, warm);
            }
            // Queries of other kinds in between share the warm start.
            if (k % 7 == 3) {
                const double tolerance = cold.distance + (k % 2 == 0 ? 0.01 : -0.01);
                ASSERT_EQ(within(pieces_a, s.world_a, pieces_b, s.world_b, std::max(0.0, tolerance),
                                 {.warm_start = &warm_start}),
                          tolerance >= cold.distance || cold.distance == 0);
            }
            if (k % 7 == 5) {
                ASSERT_EQ(
                    collide(pieces_a, s.world_a, pieces_b, s.world_b, {.warm_start = &warm_start})
                        .meet,
                    cold.distance == 0);
            }
        }
        if (testing::Test::HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(apart, many(800));
    EXPECT_GE(meet, many(100));
    EXPECT_GE(few, many(200));
}

INSTANTIATE_TEST_SUITE_P(Motions, ConvexPiecesPath, testing::Bool(),
                         [](const auto& motion) { return motion.param ? "Both" : "One"; });

TEST(ConvexPiecesCollide, FindsAllPiecesAndTriangles) {
    Random random(8106);
    std::size_t pairs = 0, triangles = 0;
    int none = 0;
    for (int i = 0; i < many(40); ++i) {
        const Model a(make_solid(random, random.integer(0, kSolidKinds - 1))),
            b(make_solid(random, random.integer(0, kSolidKinds - 1)));
        const ConvexPieces pieces_a(a), pieces_b(b);
        const Transform world_a = random.pose(0.5), world_b = random.pose(1.5);
        const PiecesContacts all = collide(pieces_a, world_a, pieces_b, world_b,
                                           {.mode = ContactMode::all, .triangles = true});
        ASSERT_EQ(all.triangles, collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs);
        std::vector<PiecePair> expected;
        std::vector<Convex> hulls_b;
        for (std::uint32_t q = 0; q < pieces_b.size(); ++q)
            hulls_b.push_back(pieces_b.hull(q));
        for (std::uint32_t p = 0; p < pieces_a.size(); ++p) {
            const Convex hull = pieces_a.hull(p);
            for (std::uint32_t q = 0; q < pieces_b.size(); ++q)
                if (distance(hull, world_a, hulls_b[q], world_b).distance == 0)
                    expected.push_back({p, q});
        }
        ASSERT_EQ(all.pairs, expected) << i;
        pairs += all.pairs.size(), triangles += all.triangles.size();
        none += all.meet ? 0 : 1;
        ASSERT_EQ(all.meet, distance(pieces_a, world_a, pieces_b, world_b).distance == 0);
    }
    EXPECT_GE(pairs, static_cast<std::size_t>(many(100)));
    EXPECT_GE(triangles, static_cast<std::size_t>(many(100)));
    EXPECT_GE(none, many(2));
}

} // namespace
} // namespace abut::test
