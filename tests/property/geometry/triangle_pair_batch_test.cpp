// SIMD kernels on every available target, against the one-lane reference and the exact or precise
// answer.

#include "geometry/leaf/triangle_pair_batch.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Triangle batch_triangle(Random& random, int kind) {
    switch (kind % 4) {
    case 0:
        return random.lattice_triangle(3);
    case 1: { // thin
        const Triangle t = random.triangle();
        return {t[0], t[1],
                0.5 * (t[0] + t[1]) + random.in_cube(std::pow(10, random.uniform(-17, 0)))};
    }
    case 2: { // small and far away
        const Vec3 away{3000.5, -70000.25, 12};
        const Triangle t = random.triangle(0.1);
        return {away + t[0], away + t[1], away + t[2]};
    }
    default:
        return random.triangle(2);
    }
}

/// Sum of three largest vertex distances: between the triangles, and within each.
double sizes(const Triangle& a, const Triangle& b) {
    double r = 0, u = 0, v = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            r = std::max(r, length(a[i] - b[k]));
            u = std::max(u, length(a[i] - a[k]));
            v = std::max(v, length(b[i] - b[k]));
        }
    return r + u + v;
}

TEST(TrianglePairBatch, DistanceEqualsTheReferenceAndTheScalarFunction) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(503);
        double worst = 0;
        int apart = 0;
        for (int i = 0; i < 20000; ++i) {
            const Triangle a = batch_triangle(random, i);
            TrianglePairBatch batch{};
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane)
                batch.set(lane, a, batch_triangle(random, i));
            double simd[TrianglePairBatch::kLanes], one[TrianglePairBatch::kLanes];
            distance_sq(batch, simd);
            distance_sq_reference(batch, one);
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane) {
                const Triangle b = batch.get_b(lane);
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

TEST(TrianglePairBatch, NearestPointsLieOnTheTrianglesAtThatDistance) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(505);
        std::cout << "seed 505\n";
        int apart = 0;
        for (int i = 0; i < many(4000); ++i) {
            const Triangle a = batch_triangle(random, i);
            TrianglePairBatch batch{};
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane)
                batch.set(lane, a, batch_triangle(random, i));
            PairPoints simd{}, one{};
            double distances[TrianglePairBatch::kLanes];
            nearest_points(batch, simd);
            nearest_points_reference(batch, one);
            distance_sq(batch, distances);
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane) {
                const Triangle b = batch.get_b(lane);
                const double unit = 0x1p-53 * size_of(a, b);
                const Vec3 on_a = simd.get_on_a(lane), on_b = on_a + simd.get_gap(lane);
                ASSERT_EQ(simd.distance_sq[lane], distances[lane]) << "case " << i;
                ASSERT_NEAR(std::sqrt(simd.distance_sq[lane]), std::sqrt(one.distance_sq[lane]),
                            64 * unit)
                    << "case " << i;
                const double rounding = 64 * unit + 0x1p-50 * length(on_a); // of positions, too
                ASSERT_NEAR(length(simd.get_gap(lane)), std::sqrt(distances[lane]), 16 * unit);
                ASSERT_LE(std::sqrt(point_triangle_distance(on_a, a).distance_sq), rounding);
                ASSERT_LE(std::sqrt(point_triangle_distance(on_b, b).distance_sq), rounding);
                apart += distances[lane] > 0 ? 1 : 0;
            }
        }
        EXPECT_GT(apart, 2 * many(4000));
    });
}

TEST(TrianglePairBatch, DistanceAgainstAHundredDigits) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(504);
        double worst = 0, most = 0;
        for (int i = 0; i < many(200); ++i) {
            const Triangle a = batch_triangle(random, i);
            TrianglePairBatch batch{};
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane) {
                Triangle b = batch_triangle(random, i);
                if (i % 2 == 1) { // a vertex just off the face, which may be a needle
                    const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
                    b[random.bits() % 3] = a[0] + s * (a[1] - a[0]) + t * (a[2] - a[0]) +
                                           random.in_cube(std::pow(10, random.uniform(-17, 0)));
                }
                if (i % 5 == 4) { // edges nearly parallel, at any distance
                    const double off = std::pow(10, random.uniform(-17, 1));
                    b = {a[0] + off * random.direction(),
                         a[1] + off * random.direction() +
                             random.in_cube(std::pow(10, random.uniform(-17, 0))),
                         a[0] + off * random.direction()};
                }
                batch.set(lane, a, b);
            }
            double simd[TrianglePairBatch::kLanes];
            distance_sq(batch, simd);
            for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane) {
                const Triangle b = batch.get_b(lane);
                const double unit = 0x1p-53 * size_of(a, b);
                const double truth = double(precise_boundary_distance(a, b));
                ASSERT_NEAR(std::sqrt(simd[lane]), truth, 64 * unit) << "case " << i;
                worst = std::max(worst, std::abs(std::sqrt(simd[lane]) - truth) / unit);
                // The promised error bound, of which at most a quarter is used.
                const double scalar = std::sqrt(triangle_triangle_distance(a, b).distance_sq);
                for (const double d : {std::sqrt(simd[lane]), scalar}) {
                    const double share = (d - truth) / (kTrianglePairError * sizes(a, b));
                    ASSERT_LE(share, 0.25) << "case " << i;
                    most = std::max(most, share);
                }
            }
        }
        std::cout << target << ": worst " << worst << " roundings, " << most << " of the bound\n";
        EXPECT_GT(most, 0.001);
    });
}

} // namespace
} // namespace abut::test
