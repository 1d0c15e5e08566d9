// Lower bounds of a point's distances to four triangles, on every available SIMD target, against
// the distances in double precision.

#include "geometry/leaf/point_leaf_distance.h"
#include "geometry/point_triangle_distance.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr std::size_t kLanes = TriangleLeaf::kLanes;

Triangle any_triangle(Random& random, int kind) {
    Triangle t = kind % 4 == 0 ? random.lattice_triangle(3) : random.triangle(1);
    if (kind % 4 == 1) // a needle
        t[2] = 0.5 * (t[0] + t[1]) + random.in_cube(std::pow(10, random.uniform(-9, 0)));
    if (kind % 16 == 2) // a segment
        t[2] = t[random.bits() % 2];
    if (kind % 16 == 3) // a point
        t[1] = t[2] = t[0];
    return t;
}

TEST(PointLeafDistance, IsALowerBoundAndMostlyTight) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(511);
        int regular = 0, tight = 0;
        for (int n = 0; n < 20000; ++n) {
            const double scale = std::pow(10, random.integer(-6, 6));
            const Vec3 away = random.chance(0.3) ? scale * random.in_cube(1e3) : Vec3{};
            std::array<Triangle, kLanes> triangles;
            for (Triangle& t : triangles) {
                t = any_triangle(random, n);
                for (Vec3& p : t)
                    p = scale * p + away;
            }
            // The point lies near the first triangle, or anywhere.
            Vec3 point = away + scale * random.in_cube(2);
            if (random.chance(0.5)) {
                const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
                const Triangle& first = triangles[0];
                point = first[0] + s * (first[1] - first[0]) + t * (first[2] - first[0]) +
                        scale * random.in_cube(std::pow(10, random.uniform(-8, 0)));
            }
            TriangleLeaf leaf{};
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                for (std::size_t v = 0; v < 3; ++v) {
                    const Vec3& p = triangles[lane][v];
                    leaf.v[v][0][lane] = static_cast<float>(p.x);
                    leaf.v[v][1][lane] = static_cast<float>(p.y);
                    leaf.v[v][2][lane] = static_cast<float>(p.z);
                }
            // The point and the vertices are rounded once each, by half an ulp.
            const double largest =
                4 * scale + std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
            const auto margin = static_cast<float>(2 * 0x1p-24 * largest);
            const std::array<float, 3> p{static_cast<float>(point.x), static_cast<float>(point.y),
                                         static_cast<float>(point.z)};
            float simd[kLanes], one[kLanes];
            point_leaf_distance_sq(leaf, p, margin, simd);
            point_leaf_distance_sq_reference(leaf, p, margin, one);
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const double truth =
                    std::sqrt(point_triangle_distance(point, triangles[lane]).distance_sq);
                // The distance in double precision may itself be off by this much.
                const double most = truth + 64 * 0x1p-53 * largest;
                ASSERT_LE(std::sqrt(double{simd[lane]}), most) << "case " << n << " lane " << lane;
                ASSERT_LE(std::sqrt(double{one[lane]}), most) << "case " << n << " lane " << lane;
                if (n % 4 == 1)
                    continue;
                ++regular;
                tight += std::sqrt(double{simd[lane]}) >=
                         (1 - 1e-4) * truth - 4 * double{margin} - 32 * 0x1p-24 * scale;
            }
        }
        EXPECT_GT(tight, 0.97 * regular) << tight << " of " << regular;
    });
}

TEST(PointLeafDistance, BoundsHoldForExtremeCoordinates) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(512);
        for (int n = 0; n < 4000; ++n) {
            const double scale = std::ldexp(1.0, random.integer(-149, 120));
            TriangleLeaf leaf{};
            std::array<Triangle, kLanes> triangles;
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                for (std::size_t v = 0; v < 3; ++v)
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        leaf.v[v][axis][lane] = static_cast<float>(scale * random.uniform(-1, 1));
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                for (std::size_t v = 0; v < 3; ++v)
                    triangles[lane][v] = {leaf.v[v][0][lane], leaf.v[v][1][lane],
                                          leaf.v[v][2][lane]};
            const std::array<float, 3> p{static_cast<float>(scale * random.uniform(-1, 1)),
                                         static_cast<float>(scale * random.uniform(-1, 1)),
                                         static_cast<float>(scale * random.uniform(-1, 1))};
            float lower_sq[kLanes];
            point_leaf_distance_sq(leaf, p, 0, lower_sq);
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                ASSERT_GE(lower_sq[lane], 0);
                const double truth =
                    point_triangle_distance({p[0], p[1], p[2]}, triangles[lane]).distance_sq;
                ASSERT_LE(std::sqrt(double{lower_sq[lane]}),
                          std::sqrt(truth) * (1 + 1e-12) + 0x1p-160)
                    << "case " << n << " scale " << scale;
            }
        }
    });
}

} // namespace
} // namespace abut::test
