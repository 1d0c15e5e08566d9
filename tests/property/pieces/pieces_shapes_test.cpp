// Solids of convex pieces in shapes and places where an error bound could fail: slivers, needles,
// far from the origin, flattened, moved by single bits. All queries are checked against every pair
// of triangles.

#include <abut/convex_pieces.h>
#include <abut/error.h>

#include "tests/support/oracle/pieces_truth.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct Tally {
    int meet = 0, apart = 0;
    void add(bool do_meet) { ++(do_meet ? meet : apart); }
};

/// Queries two solids at distances from 2 * `size` down to 0 along a random direction, with one
/// warm start.
void approach(const ConvexPieces& a, const Transform& world_a, const ConvexPieces& b,
              const Transform& turned_b, double size, Random& random, Tally& tally) {
    PiecesWarmStart warm_start;
    const Vec3 way = random.direction();
    for (const double share : {2.0, 1.0, 0.5, 0.1, 1e-2, 1e-4, 1e-8, 0.0}) {
        Transform world_b = translated(turned_b, share * size * way);
        tally.add(agree(a, world_a, b, world_b, &warm_start, random));
        world_b.m[10] = std::nextafter(world_b.m[10], 1e300);
        tally.add(agree(a, world_a, b, world_b, &warm_start, random));
    }
}

/// A random solid, scaled in its own frame. If rounding turns parts of it inside out, another kind
/// is taken.
ConvexPieces scaled_solid(Random& random, int kind, const Transform& scale) {
    for (;; ++kind)
        try {
            return ConvexPieces{Model(transformed(make_solid(random, kind), scale))};
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_mesh);
        }
}

/// Solids scaled to 1e-3 to 1e-12 of their size along an axis.
TEST(PiecesShapes, Slivers) {
    Random random(8140);
    Tally tally;
    for (int i = 0; i < many(20); ++i) {
        const double thin = std::pow(10, random.uniform(-12, -3));
        const ConvexPieces a = scaled_solid(random, i, scaling(1, 1, thin)),
                           b = scaled_solid(random, random.integer(0, kSolidKinds - 1),
                                            i % 2 == 0 ? scaling(1, 1, thin) : scaling(1, 1, 1));
        const bool is_parallel = i % 3 == 0;
        const Transform world_a = random.pose(i % 2);
        approach(a, world_a, b, is_parallel ? world_a : compose(world_a, random.pose(0)),
                 is_parallel ? 4 * thin : 4, random, tally);
        if (HasFailure())
            FAIL() << "case " << i << " thickness " << thin;
    }
    EXPECT_GE(tally.meet, many(15));
    EXPECT_GE(tally.apart, many(20));
}

/// Solids 1e2 to 1e7 times as long as wide.
TEST(PiecesShapes, Needles) {
    Random random(8141);
    Tally tally;
    for (int i = 0; i < many(20); ++i) {
        const double wide = std::pow(10, random.uniform(-4, 0)),
                     length = std::pow(10, random.uniform(2, 7)) * wide;
        const Transform needle = scaling(length, wide, wide * random.uniform(0.1, 1));
        const ConvexPieces a = scaled_solid(random, i, needle),
                           b = scaled_solid(random, random.integer(0, kSolidKinds - 1), needle);
        const Transform world_a = random.pose(i % 2);
        const bool is_parallel = i % 2 == 0;
        approach(a, world_a, b, is_parallel ? world_a : compose(world_a, random.pose(0)),
                 is_parallel ? 3 * wide : length, random, tally);
        if (HasFailure())
            FAIL() << "case " << i << " length " << length << " width " << wide;
    }
    EXPECT_GE(tally.meet, many(15));
    EXPECT_GE(tally.apart, many(20));
}

/// Solids near each other, up to 1e9 sizes away from the origin.
TEST(PiecesShapes, FarFromTheOrigin) {
    Random random(8142);
    Tally tally;
    for (int i = 0; i < many(20); ++i) {
        const ConvexPieces a{Model(make_solid(random, i))},
            b{Model(make_solid(random, random.integer(0, kSolidKinds - 1)))};
        const Vec3 away = std::pow(10, random.uniform(3, 9)) * random.direction();
        const Transform world_a = translated(random.pose(0), away);
        const Transform world_b = i % 3 == 0 ? world_a : translated(random.pose(0), away);
        approach(a, world_a, b, world_b, 2, random, tally);
        if (HasFailure())
            FAIL() << "case " << i << " at " << away.x << ' ' << away.y << ' ' << away.z;
    }
    EXPECT_GE(tally.meet, many(15));
    EXPECT_GE(tally.apart, many(20));
}

/// Singular transforms: a solid becomes a plate, a segment or a point.
TEST(PiecesShapes, Flattened) {
    Random random(8143);
    Tally tally;
    for (int i = 0; i < many(20); ++i) {
        const ConvexPieces a{Model(make_solid(random, i))},
            b{Model(make_solid(random, random.integer(0, kSolidKinds - 1)))};
        const int rank = i % 4; // 3: only b is flat
        const Transform flat = rank == 0   ? scaling(0, 0, 0)
                               : rank == 1 ? scaling(1, 0, 0)
                                           : scaling(1, 1, 0);
        const Transform world_a = compose(random.pose(0), rank == 3 ? scaling(1, 1, 1) : flat),
                        world_b = compose(random.pose(0), flat);
        approach(a, world_a, b, world_b, 3, random, tally);
        if (HasFailure())
            FAIL() << "case " << i << " rank " << rank;
    }
    EXPECT_GE(tally.meet, many(15));
    EXPECT_GE(tally.apart, many(40));
}

} // namespace
} // namespace abut::test
