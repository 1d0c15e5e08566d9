// The SIMD kernels, on every target that this machine has, against the one-lane reference and the
// exact or precise answer.

#include "geometry/triangle_block.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/precise_distance.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Triangle any_triangle(Random& random, int kind) {
    switch (kind % 4) {
    case 0:
        return random.lattice_triangle(3);
    case 1: { // thin
        const Triangle t = random.triangle();
        return {t[0], t[1],
                0.5 * (t[0] + t[1]) + random.in_cube(std::pow(10, random.uniform(-17, 0)))};
    }
    case 2: { // far off, small
        const Vec3 away{3000.5, -70000.25, 12};
        const Triangle t = random.triangle(0.1);
        return {away + t[0], away + t[1], away + t[2]};
    }
    default:
        return random.triangle(2);
    }
}

TrianglePairBlock pairs_of(const Triangle& a, const TriangleBlock& b) {
    TrianglePairBlock pairs{};
    for (std::size_t lane = 0; lane < TrianglePairBlock::kLanes; ++lane)
        pairs.set(lane, a, b, lane % TriangleBlock::kLanes);
    return pairs;
}

TEST(TriangleBlock, MayIntersectIsConservativeAndSharp) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(501);
        int meeting = 0, apart = 0, rejected = 0, differ = 0;
        for (int i = 0; i < 60000; ++i) {
            const Triangle a = any_triangle(random, i);
            TriangleBlock block{};
            std::array<Triangle, TriangleBlock::kLanes> b;
            for (std::size_t lane = 0; lane < b.size(); ++lane) {
                b[lane] = any_triangle(random, i);
                if (random.chance(0.2)) // share a vertex, or almost
                    b[lane][random.bits() % 3] =
                        random.nudge(a[random.bits() % 3], random.integer(0, 1));
                block.set(lane, b[lane]);
                ASSERT_EQ(block.get(lane), b[lane]);
            }
            const std::uint32_t mask = may_intersect(a, block);
            ASSERT_LT(mask, 16U);
            differ += mask != may_intersect_reference(a, block) ? 1 : 0;
            for (std::uint32_t lane = 0; lane < b.size(); ++lane) {
                const bool may = (mask >> lane & 1U) != 0;
                if (triangle_triangle_intersect(a, b[lane]) != TriangleContact::none) {
                    ++meeting;
                    ASSERT_TRUE(may) << "case " << i << ", lane " << lane;
                } else {
                    ++apart;
                    rejected += may ? 0 : 1;
                }
            }
        }
        EXPECT_GT(meeting, 40000);
        EXPECT_GT(apart, 40000);
        EXPECT_GT(rejected, apart * 0.7);
        EXPECT_LT(differ, 600); // only where a sign is within its rounding
    });
}

TEST(TriangleBlock, ExtremeCoordinatesStayConservative) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(502);
        int meeting = 0;
        for (int i = 0; i < 4000; ++i) {
            const double scale = std::ldexp(1, random.chance(0.5) ? 1019 : -1074);
            const auto make = [&] {
                Triangle t = random.lattice_triangle(4);
                for (Vec3& p : t)
                    p = {scale * p.x, scale * p.y, scale * p.z};
                return t;
            };
            const Triangle a = make();
            TriangleBlock block{};
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane)
                block.set(lane, make());
            const std::uint32_t mask = may_intersect(a, block),
                                reference = may_intersect_reference(a, block);
            for (std::uint32_t lane = 0; lane < TriangleBlock::kLanes; ++lane)
                if (triangle_triangle_intersect(a, block.get(lane)) != TriangleContact::none) {
                    ++meeting;
                    ASSERT_TRUE(mask >> lane & 1U);
                    ASSERT_TRUE(reference >> lane & 1U);
                }
        }
        EXPECT_GT(meeting, 2000);
    });
}

TEST(TriangleBlock, NearLanesLoseNothingWithinTheBound) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(505);
        int near = 0, far = 0, left_out = 0;
        for (int i = 0; i < 20000; ++i) {
            const Triangle a = any_triangle(random, i);
            TriangleBlock block{};
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane)
                block.set(lane, any_triangle(random, i));
            double one[TrianglePairBlock::kLanes];
            distance_sq_reference(pairs_of(a, block), one);
            // At a lane's own distance, and below it.
            const double bound_sq = one[0] * (i % 2 == 0 ? 1 : random.uniform(0, 1));
            const NearLanes lanes = near_lanes(a, block, bound_sq);
            const NearLanes reference = near_lanes_reference(a, block, bound_sq);
            for (std::uint32_t lane = 0; lane < TriangleBlock::kLanes; ++lane) {
                const bool meet =
                    triangle_triangle_intersect(a, block.get(lane)) != TriangleContact::none;
                if (meet) {
                    ASSERT_TRUE(lanes.may_intersect >> lane & 1U);
                    ASSERT_TRUE(reference.may_intersect >> lane & 1U);
                }
                if (meet || one[lane] <= bound_sq) {
                    ++near;
                    ASSERT_TRUE(lanes.may_be_near >> lane & 1U) << "case " << i;
                    ASSERT_TRUE(reference.may_be_near >> lane & 1U) << "case " << i;
                } else {
                    ++far;
                    left_out += (lanes.may_be_near >> lane & 1U) == 0 ? 1 : 0;
                }
            }
        }
        EXPECT_GT(near, 10000);
        EXPECT_GT(left_out, far / 5);
    });
}

TEST(TriangleBlock, DistanceIsThatOfTheReferenceAndOfTheScalarFunction) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(503);
        double worst = 0;
        int apart = 0;
        for (int i = 0; i < 20000; ++i) {
            const Triangle a = any_triangle(random, i);
            TriangleBlock block{};
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane)
                block.set(lane, any_triangle(random, i));
            double simd[TrianglePairBlock::kLanes], one[TrianglePairBlock::kLanes];
            distance_sq(pairs_of(a, block), simd);
            distance_sq_reference(pairs_of(a, block), one);
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane) {
                const Triangle b = block.get(lane);
                const double unit = 0x1p-53 * size_of(a, b);
                const double d = std::sqrt(simd[lane]);
                ASSERT_NEAR(d, std::sqrt(one[lane]), 64 * unit) << "case " << i;
                worst = std::max(worst, std::abs(d - std::sqrt(one[lane])) / unit);
                if (triangle_triangle_intersect(a, b) == TriangleContact::none) {
                    ++apart;
                    ASSERT_NEAR(d, std::sqrt(triangle_triangle_distance(a, b).distance_sq),
                                64 * unit)
                        << "case " << i;
                }
            }
        }
        std::cout << target << ": worst " << worst << " roundings\n";
        EXPECT_GT(apart, 30000);
    });
}

TEST(TriangleBlock, DistanceAgainstAHundredDigits) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(504);
        double worst = 0;
        for (int i = 0; i < 200; ++i) {
            const Triangle a = any_triangle(random, i);
            TriangleBlock block{};
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane) {
                Triangle b = any_triangle(random, i);
                if (i % 2 == 1) { // a vertex just off the face, which may be a needle
                    const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
                    b[random.bits() % 3] = a[0] + s * (a[1] - a[0]) + t * (a[2] - a[0]) +
                                           random.in_cube(std::pow(10, random.uniform(-17, 0)));
                }
                block.set(lane, b);
            }
            double simd[TrianglePairBlock::kLanes];
            distance_sq(pairs_of(a, block), simd);
            for (std::size_t lane = 0; lane < TriangleBlock::kLanes; ++lane) {
                const Triangle b = block.get(lane);
                const double unit = 0x1p-53 * size_of(a, b);
                const double truth = double(precise_boundary_distance(a, b));
                ASSERT_NEAR(std::sqrt(simd[lane]), truth, 64 * unit) << "case " << i;
                worst = std::max(worst, std::abs(std::sqrt(simd[lane]) - truth) / unit);
            }
        }
        std::cout << target << ": worst " << worst << " roundings\n";
    });
}

} // namespace
} // namespace abut::test
