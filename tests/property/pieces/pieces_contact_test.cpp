// Solids of convex pieces that touch, or almost do: all queries against every pair of triangles
// with exact signs, and against each other.

#include <abut/convex_pieces.h>

#include "tests/support/oracle/pieces_truth.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>
#include <map>

namespace abut::test {
namespace {

/// A cube with bulging sides: each side has `parts` x `parts` squares, and the middle of each
/// square is moved outwards.
Mesh bulged_cube(Random& random, double least, double most, int parts) {
    Mesh m;
    std::map<std::array<double, 3>, std::uint32_t> numbers;
    const auto vertex = [&](const std::array<double, 3>& p) {
        const auto number = static_cast<std::uint32_t>(m.positions.size());
        const auto [at, added] = numbers.try_emplace(p, number);
        if (added)
            m.positions.push_back({p[0], p[1], p[2]});
        return at->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const double bulge = std::exp(random.uniform(std::log(least), std::log(most)));
            const auto point = [&](double u, double v, double out) {
                std::array<double, 3> p{};
                p[axis] = side * (1 + out);
                p[(axis + 1) % 3] = -1 + 2 * u / parts;
                p[(axis + 2) % 3] = -1 + 2 * v / parts;
                return vertex(p);
            };
            for (int i = 0; i < parts; ++i)
                for (int j = 0; j < parts; ++j) {
                    std::array<std::uint32_t, 4> ring{point(i, j, 0), point(i + 1, j, 0),
                                                      point(i + 1, j + 1, 0), point(i, j + 1, 0)};
                    if (side < 0)
                        std::swap(ring[1], ring[3]);
                    const std::uint32_t middle = point(i + 0.5, j + 0.5, bulge);
                    for (std::size_t k = 0; k < 4; ++k)
                        m.triangles.push_back({ring[k], ring[(k + 1) % 4], middle});
                }
        }
    return m;
}

/// A walk from the last step's features may end on the back of two faces.
TEST(PiecesContact, ABoxMovedALittleMeetsItself) {
    Random random(8134);
    const ConvexPieces box{Model(box_mesh({-1, -1, -1}, {1, 1, 1}))};
    for (int i = 0; i < many(20000); ++i) {
        const Transform world_a = random.pose(0.5);
        Transform world_b = world_a;
        PiecesWarmStart warm_start;
        const auto expect_contact = [&] {
            const PiecesGap gap = distance(box, world_a, box, world_b, {.warm_start = &warm_start});
            ASSERT_EQ(gap.distance, 0) << i;
            ASSERT_EQ(gap.at_least, 0) << i;
        };
        expect_contact();
        world_b.m[9] = std::nextafter(world_b.m[9], 9);
        expect_contact();
        world_b = translated(world_b, {6.3e-4, 1.9e-4, -7.5e-4});
        expect_contact();
    }
}

/// Bodies at the same place move apart by one unit in the last place, then by a little more.
TEST(PiecesContact, AStepAwayFromTheSamePlace) {
    Random random(8130);
    int steps = 0, apart = 0;
    for (int i = 0; i < many(12); ++i) {
        const bool is_box = i % 3 == 0;
        const ConvexPieces a{Model(is_box ? box_mesh({-1, -1, -1}, {1, 1, 1})
                                          : make_solid(random, random.integer(0, 9)))};
        for (int k = 0; k < (is_box ? 40 : 4); ++k) {
            const Transform world_a = random.pose(k % 2);
            Transform world_b = world_a;
            PiecesWarmStart warm_start;
            agree(a, world_a, a, world_b, &warm_start, random);
            world_b.m[9] = std::nextafter(world_b.m[9], 9);
            agree(a, world_a, a, world_b, &warm_start, random);
            for (int step = 0; step < 3; ++step, ++steps) {
                const double by = step == 2             ? random.uniform(0, 6)
                                  : step == 0 && is_box ? 1e-3
                                                        : std::pow(10, random.uniform(-8, 0));
                world_b = translated(world_b, by * random.direction());
                apart += agree(a, world_a, a, world_b, &warm_start, random) ? 0 : 1;
            }
        }
        if (HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(steps, many(250));
    EXPECT_GE(apart, many(20));
}

/// The sides bulge by 1e-12 to 1e-6.
TEST(PiecesContact, BulgedCubes) {
    Random random(8131);
    int apart = 0, meet = 0;
    const int cases = many(70);
    for (int i = 0; i < cases; ++i) {
        const double bulge = std::pow(10, -12 + i % 7);
        const ConvexPieces a{Model(bulged_cube(random, bulge, 10 * bulge, random.integer(1, 2)))},
            b{Model(i % 2 == 0 ? box_mesh({-1, -1, -1}, {1, 1, 1})
                               : bulged_cube(random, bulge, 10 * bulge, 1))};
        for (int k = 0; k < 8; ++k) {
            const std::array gaps{1.5, bulge * random.uniform(0, 30),
                                  std::pow(10, random.uniform(-9, 0)),
                                  bulge * random.uniform(-10, 10)};
            const double aside = k % 3 == 0 ? 0 : 1.5;
            Transform world_a,
                world_b = translation(2 + gaps.at(static_cast<std::size_t>(k % 4)),
                                      random.uniform(-aside, aside), random.uniform(-aside, aside));
            if (k == 5) { // not quite parallel
                const double turn = random.uniform(-bulge, bulge);
                world_b = compose(world_b, Transform(Pose{{}, {1, 0, turn, -turn}}));
            }
            if (k >= 4) {
                world_a = random.pose(k < 6 ? 0 : 3);
                world_b = compose(world_a, world_b);
            }
            (agree(a, world_a, b, world_b, nullptr, random) ? meet : apart) += 1;
        }
        if (HasFailure())
            FAIL() << "case " << i << " bulge " << bulge;
    }
    EXPECT_GE(apart, 5 * cases);
    EXPECT_GE(meet, cases);
}

/// Contacts at a point, along an edge or on a face, exactly on a lattice and rotated.
TEST(PiecesContact, SolidsThatTouch) {
    Random random(8132);
    int touch = 0, meet = 0, apart = 0;
    for (int i = 0; i < many(30); ++i) {
        const ConvexPieces a{Model(random_cells(random, 2))},
            b{Model(i % 3 == 0 ? box_mesh({0, 0, 0}, {1, 1, 1}) : random_cells(random, 2))};
        for (int k = 0; k < 12; ++k) {
            const Vec3 at = random.on_lattice(4) - Vec3{2, 2, 2};
            Transform world_a, world_b = translation(at.x, at.y, at.z);
            if (k % 3 == 1)
                world_b = translation(at.x, at.y + 0.25, at.z - 0.5);
            if (k % 2 == 1) {
                world_a = random.pose(k % 4);
                world_b = compose(world_a, world_b);
            }
            const bool do_meet = agree(a, world_a, b, world_b, nullptr, random);
            (do_meet ? meet : apart) += 1;
            const PiecesDepth depth = penetration(a, world_a, b, world_b, {.separation = false});
            if (do_meet && depth.depth < 1e-9) {
                ++touch;
                // The separating motion may be as short as rounding, and still it separates.
                const PiecesDepth found = penetration(a, world_a, b, world_b);
                EXPECT_FALSE(
                    distance(a, world_a, b, translated(world_b, found.separation)).distance == 0);
            }
        }
        if (HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(touch, many(20));
    EXPECT_GE(meet, many(100));
    EXPECT_GE(apart, many(50));
}

/// The solids touch up to rounding, then are moved apart and into each other, by up to 1e-2.
TEST(PiecesContact, ShallowPoses) {
    Random random(8133);
    int meet = 0, apart = 0;
    for (int i = 0; i < many(24); ++i) {
        const ConvexPieces a{Model(make_solid(random, i))},
            b{Model(make_solid(random, random.integer(0, kSolidKinds - 1)))};
        const Transform world_a = random.pose(0), turn = random.pose(0);
        const Vec3 direction = random.direction();
        const auto placed = [&](double by) {
            const Vec3 at = by * direction;
            return compose(translation(at.x, at.y, at.z), turn);
        };
        double offset = 8;
        for (int step = 0; step < 100 && offset > 0; ++step) {
            const double gap = distance(a.model(), world_a, b.model(), placed(offset)).distance;
            offset -= gap;
            if (gap < 1e-12)
                break;
        }
        if (offset < 0)
            continue; // b passes through the hole of a
        PiecesWarmStart warm_start;
        for (const double by : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 0.0, -1e-15, -1e-14,
                                -1e-12, -1e-10, -1e-8, -1e-6, -1e-4})
            (agree(a, world_a, b, placed(offset + by), &warm_start, random) ? meet : apart) += 1;
        if (HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(meet, many(60));
    EXPECT_GE(apart, many(60));
}

} // namespace
} // namespace abut::test
