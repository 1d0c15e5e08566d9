// Four triangles against four in single precision, on every available SIMD target. Whatever the
// kernel calls certain must be true of the triangles in double precision.

#include "geometry/leaf/triangle_leaf.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/transform.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Four = std::array<Triangle, TriangleLeaf::kLanes>;

/// Two leaves; b's vertices are in a frame of its own.
struct Leaves {
    Four a, b; ///< in a's frame, to a few roundings
    TriangleLeaf leaf_a{}, leaf_b{};
    LeafPlacement placement;

    Leaves(Random& random, int kind, double scale) {
        const Transform a_from_b = random.pose(scale), b_from_a = inverse(a_from_b);
        for (std::size_t lane = 0; lane < a.size(); ++lane) {
            a[lane] = triangle(random, kind, scale);
            b[lane] = triangle(random, kind, scale);
            if (random.chance(0.2)) // shares a vertex, or almost
                b[lane][random.bits() % 3] =
                    random.nudge(a[random.bits() % 4][random.bits() % 3], random.integer(0, 1));
        }
        store(a, {}, leaf_a);
        store(b, b_from_a, leaf_b);
        double reach = scale;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                placement.linear[k][i] = static_cast<float>(a_from_b.m[3 * k + i]);
            placement.translation[i] = static_cast<float>(a_from_b.m[9 + i]);
            reach += std::abs(a_from_b.m[9 + i]);
        }
        placement.margin = static_cast<float>(64 * 0x1p-24 * 4 * reach);
    }

private:
    static Triangle triangle(Random& random, int kind, double scale) {
        Triangle t = kind % 3 == 0 ? random.lattice_triangle(3) : random.triangle(1);
        if (kind % 3 == 1) // thin
            t[2] = 0.5 * (t[0] + t[1]) + random.in_cube(std::pow(10, random.uniform(-9, 0)));
        for (Vec3& p : t)
            p = 0.5 * scale * p;
        return t;
    }
    static void store(const Four& triangles, const Transform& to_leaf, TriangleLeaf& leaf) {
        for (std::size_t lane = 0; lane < triangles.size(); ++lane)
            for (std::size_t v = 0; v < 3; ++v) {
                const Vec3 p = apply(to_leaf, triangles[lane][v]);
                leaf.v[v][0][lane] = static_cast<float>(p.x);
                leaf.v[v][1][lane] = static_cast<float>(p.y);
                leaf.v[v][2][lane] = static_cast<float>(p.z);
            }
    }
};

bool has(std::uint32_t pairs, std::size_t i, std::size_t j) {
    return (pairs >> (4 * i + j) & 1U) != 0;
}

TEST(TriangleLeaf, CertainAnswersAreTrue) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(501);
        int meeting = 0, crossing = 0, told = 0, apart = 0, rejected = 0, differ = 0;
        for (int n = 0; n < 20000; ++n) {
            const double scale = std::pow(10, random.integer(-6, 6));
            const Leaves leaves(random, n, scale);
            const LeafPairs pairs = meeting_pairs(leaves.leaf_a, leaves.leaf_b, leaves.placement);
            const LeafPairs one =
                meeting_pairs_reference(leaves.leaf_a, leaves.leaf_b, leaves.placement);
            differ += pairs.cross != one.cross || pairs.may_meet != one.may_meet ? 1 : 0;
            for (const LeafPairs& p : {pairs, one}) {
                ASSERT_EQ(p.cross & p.may_meet, 0U);
                ASSERT_LT(p.any(), 0x10000U);
                for (std::size_t i = 0; i < 4; ++i)
                    for (std::size_t j = 0; j < 4; ++j) {
                        const auto kind = triangle_triangle_intersect(leaves.a[i], leaves.b[j]);
                        if (kind == TriangleContact::none) {
                            ++apart;
                            rejected += has(p.may_meet, i, j) ? 0 : 1;
                            ASSERT_FALSE(has(p.cross, i, j)) << "case " << n;
                            continue;
                        }
                        ++meeting;
                        ASSERT_TRUE(has(p.any(), i, j)) << "case " << n;
                        crossing += kind == TriangleContact::cross ? 1 : 0;
                        if (has(p.cross, i, j)) {
                            ++told;
                            ASSERT_EQ(kind, TriangleContact::cross) << "case " << n;
                        }
                    }
            }
        }
        EXPECT_GT(meeting, 40000);
        EXPECT_GT(apart, 40000);
        EXPECT_GT(rejected, apart * 0.6);
        EXPECT_GT(told, crossing * 0.5);
        EXPECT_LT(differ, 200); // they differ only where a sign is within its error bound
    });
}

TEST(TriangleLeaf, NearPairsIncludeAllWithinTheBound) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(505);
        int near = 0, far = 0, left_out = 0, along = 0;
        for (int n = 0; n < 8000; ++n) {
            const double scale = std::pow(10, random.integer(-6, 6));
            const Leaves leaves(random, n, scale);
            // The bound is the distance of one pair, or less. Some bounds have the direction of the
            // pair's witness points.
            const ClosestPoints first = triangle_triangle_distance(leaves.a[0], leaves.b[0]);
            const double bound_sq = first.distance_sq * (n % 2 == 0 ? 1 : random.uniform(0, 1));
            LeafBound bound{static_cast<float>(bound_sq * (1 + 0x1p-22)),
                            static_cast<float>(bound_sq * (1 + 0x1p-22)),
                            {}};
            const LeafPairs without =
                near_pairs(leaves.leaf_a, leaves.leaf_b, leaves.placement, bound);
            const Vec3 d = (1 - 0x1p-20) *
                           normalized_or_zero(n % 3 == 0 ? random.direction() : first.b - first.a);
            bound.direction = {static_cast<float>(d.x), static_cast<float>(d.y),
                               static_cast<float>(d.z)};
            const LeafPairs pairs =
                near_pairs(leaves.leaf_a, leaves.leaf_b, leaves.placement, bound);
            const LeafPairs one =
                near_pairs_reference(leaves.leaf_a, leaves.leaf_b, leaves.placement, bound);
            along += std::popcount(without.any()) - std::popcount(pairs.any());
            for (const LeafPairs& p : {without, pairs, one})
                for (std::size_t i = 0; i < 4; ++i)
                    for (std::size_t j = 0; j < 4; ++j) {
                        const bool meet = triangle_triangle_intersect(leaves.a[i], leaves.b[j]) !=
                                          TriangleContact::none;
                        if (meet ||
                            triangle_triangle_distance(leaves.a[i], leaves.b[j]).distance_sq <=
                                bound_sq) {
                            ++near;
                            ASSERT_TRUE(has(p.any(), i, j)) << "case " << n;
                            ASSERT_TRUE(!meet || has(p.cross | p.may_meet, i, j));
                        } else {
                            ++far;
                            left_out += has(p.any(), i, j) ? 0 : 1;
                        }
                    }
        }
        EXPECT_GT(near, 10000);
        EXPECT_GT(left_out, far / 5);
        EXPECT_GT(along, 100);
    });
}

TEST(TriangleLeaf, CertainAnswersAreTrueForExtremeCoordinates) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(502);
        int meeting = 0;
        for (int n = 0; n < 2000; ++n) {
            const Leaves leaves(random, n, random.chance(0.5) ? 0x1p+60 : 0x1p-60);
            const LeafPairs pairs = meeting_pairs(leaves.leaf_a, leaves.leaf_b, leaves.placement);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) {
                    const auto kind = triangle_triangle_intersect(leaves.a[i], leaves.b[j]);
                    meeting += kind != TriangleContact::none ? 1 : 0;
                    ASSERT_TRUE(kind == TriangleContact::none || has(pairs.any(), i, j));
                    ASSERT_TRUE(kind == TriangleContact::cross || !has(pairs.cross, i, j));
                }
        }
        EXPECT_GT(meeting, 1000);
    });
}

} // namespace
} // namespace abut::test
