// Building blocks of convex queries: farthest vertices on every SIMD target, and inner balls.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/property/convex/convex_search_test.cpp"
#include "simd/foreach_target.h"
#include "convex/hull/climb-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

void look_at_ring(const Polytope& polytope, const HullVertex& vertex, const Vec3& direction,
                  double& excess, std::uint32_t& edge) {
    const rings::HighestNeighbour highest = rings::highest_neighbour(polytope, vertex, direction);
    excess = highest.excess, edge = highest.edge;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "convex/body/convex_data.h"
#include "convex/hull/climb.h"
#include "math/transform.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut {

HWY_EXPORT(look_at_ring);

namespace test {
namespace {

/// Random points on an ellipsoid; every third time on a coarse grid, so that many are equally far.
ConvexData random_hull(Random& random, int count, int kind) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const Vec3 d = random.direction();
        const Vec3 p{d.x, 0.7 * d.y, 0.4 * d.z};
        points.push_back(kind % 3 != 0
                             ? p
                             : Vec3{std::round(4 * p.x), std::round(4 * p.y), std::round(4 * p.z)});
    }
    return ConvexData(points);
}

/// The tip of a cone is a neighbour of all other vertices.
ConvexData cone(int corners) {
    std::vector<Vec3> points{{0, 0, 1}};
    for (int i = 0; i < corners; ++i) {
        const double angle = 6.28 * i / corners;
        points.push_back({std::cos(angle), std::sin(angle), 0});
    }
    return ConvexData(points);
}

/// Rounding of heights of points that are at most 5 from the origin.
constexpr double kRounding = 1e-14;

double highest(const ConvexData& body, const Vec3& direction) {
    double most = -HUGE_VAL;
    for (const Vec3& p : body.vertices)
        most = std::max(most, dot(direction, p));
    return most;
}

bool same(const ConvexGap& g, const ConvexGap& h) {
    return g.distance == h.distance && g.point_a == h.point_a && g.point_b == h.point_b &&
           g.feature_a == h.feature_a && g.id_a == h.id_a && g.id_b == h.id_b &&
           g.counters.feature_pairs == h.counters.feature_pairs;
}

/// Covers both methods: small hulls test all vertices, larger ones climb from neighbour to
/// neighbour.
TEST(ConvexSearch, FindsTheFarthestVerticesOnEverySimdTarget) {
    Random random(7301);
    int small = 0, large = 0, mixed = 0;
    const int rounds = many(300);
    for (int i = 0; i < rounds; ++i) {
        const auto hull = [&](int k) {
            return k % 5 == 0 ? cone(random.integer(3, 90))
                              : random_hull(random, random.integer(1, k % 2 == 0 ? 60 : 400), k);
        };
        const ConvexData a = hull(i), b = hull(random.integer(0, 29));
        const Polytope &p = a.levels[0].polytope, &q = b.levels[0].polytope;
        (p.columns.empty() != q.columns.empty() ? mixed : p.columns.empty() ? large : small) += 1;
        const Transform world_a = random.pose(1), world_b = random.pose(1);
        const PolytopePair pair(p, world_a, q, world_b);
        const Vec3 direction = random.direction();
        const Vec3 along_a = pair.a.pulled_back(direction),
                   along_b = pair.b.pulled_back(-direction);
        for_each_simd_target([&](const std::string& target) {
            const VertexPair found = farthest(pair, direction);
            ASSERT_LT(found.a, a.vertices.size()) << target;
            ASSERT_LT(found.b, b.vertices.size()) << target;
            EXPECT_NEAR(dot(along_a, p.vertices[found.a].at), highest(a, along_a), kRounding)
                << target;
            EXPECT_NEAR(dot(along_b, q.vertices[found.b].at), highest(b, along_b), kRounding)
                << target;
            const std::uint32_t from_zero = climb(p, along_a, 0);
            EXPECT_NEAR(dot(along_a, p.vertices[from_zero].at), highest(a, along_a), kRounding)
                << target;
        });
    }
    EXPECT_GT(small, rounds / 10);
    EXPECT_GT(large, rounds / 20);
    EXPECT_GT(mixed, rounds / 10);
}

TEST(ConvexSearch, HighestNeighboursEqualThoseOfTheRing) {
    Random random(7302);
    int higher = 0, rounds = 0;
    for (int i = 0; i < many(60); ++i) {
        const ConvexData body = i % 5 == 0 ? cone(random.integer(3, 40))
                                           : random_hull(random, random.integer(4, 300), i);
        const Polytope& p = body.levels[0].polytope;
        const Vec3 direction = random.direction();
        for (const HullVertex& v : p.vertices) {
            double most = 0;
            for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
                most = std::max(most, dot(direction, p.to(e) - v.at));
            ++rounds;
            higher += most > 0 ? 1 : 0;
            for_each_simd_target([&](const std::string& target) {
                double excess = 0;
                std::uint32_t edge = 0;
                HWY_DYNAMIC_DISPATCH(look_at_ring)(p, v, direction, excess, edge);
                ASSERT_EQ(excess, most) << target;
                ASSERT_LT(edge - v.first_edge, std::max(v.degree, 1U)) << target;
                if (most > 0) {
                    ASSERT_EQ(dot(direction, p.to(edge) - v.at), most) << target;
                }
            });
        }
    }
    EXPECT_GT(higher, rounds / 2);
    EXPECT_LT(higher, rounds);
}

/// Neighbours, witness points and expanding polytopes are computed by SIMD kernels, which round
/// alike on every target.
TEST(ConvexSearch, AnswersAreTheSameOnEverySimdTarget) {
    Random random(7302);
    const auto points = [&](int k) {
        return (k % 5 == 0 ? cone(random.integer(3, 40))
                           : random_hull(random, random.integer(1, k % 2 == 0 ? 60 : 300), k))
            .vertices;
    };
    int apart = 0, deep = 0, targets = 0;
    const int rounds = many(200);
    for (int i = 0; i < rounds; ++i) {
        const Convex a(points(i)), b(points(random.integer(0, 29)));
        const Transform world_a = random.pose(0.3), world_b = random.pose(1);
        ConvexWarmStart last;
        (void)distance(a, random.pose(0.3), b, world_b, {.warm_start = &last});
        ConvexGap first_gap, first_step;
        ConvexDepth first_depth;
        targets = 0;
        for_each_simd_target([&](const std::string& target) {
            ConvexWarmStart warm_start = last;
            const ConvexGap gap = distance(a, world_a, b, world_b);
            const ConvexGap step = distance(a, world_a, b, world_b, {.warm_start = &warm_start});
            const ConvexDepth depth = penetration(a, world_a, b, world_b);
            if (targets++ == 0)
                first_gap = gap, first_step = step, first_depth = depth;
            EXPECT_TRUE(same(gap, first_gap) && same(step, first_step)) << target;
            EXPECT_EQ(depth.depth, first_depth.depth) << target;
            EXPECT_EQ(depth.point_b, first_depth.point_b) << target;
            EXPECT_EQ(depth.counters.simplices, first_depth.counters.simplices) << target;
        });
        apart += first_gap.distance > 0 ? 1 : 0;
        deep += first_depth.depth > 0 ? 1 : 0;
    }
    EXPECT_GT(targets, 1);
    EXPECT_GT(apart, rounds / 10);
    EXPECT_GT(deep, rounds / 5);
}

/// Depth of a point below a triangle's plane, in long double.
long double depth_below(const ConvexData& body, const IndexTriangle& triangle, const Vec3& point) {
    using Long = std::array<long double, 3>;
    const auto from_point = [&](std::uint32_t v) -> Long {
        const Vec3& p = body.vertices[v];
        return {0.0L + p.x - point.x, 0.0L + p.y - point.y, 0.0L + p.z - point.z};
    };
    const Long p = from_point(triangle[0]), q = from_point(triangle[1]),
               r = from_point(triangle[2]);
    long double height = 0, size_sq = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const long double normal = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
        height += normal * p[i];
        size_sq += normal * normal;
    }
    return height / std::sqrt(size_sq);
}

TEST(ConvexSearch, InnerBallsLieInsideAndAreNotMuchTooSmall) {
    Random random(7303);
    int solid = 0;
    const int rounds = many(300);
    for (int i = 0; i < rounds; ++i) {
        const double scale = std::ldexp(1.0, random.integer(-30, 30));
        const Vec3 shift = random.uniform(0, 100) * random.direction();
        std::vector<Vec3> points;
        const double thin = i % 4 == 0 ? 1e-5 : 0.6;
        for (int k = random.integer(4, 120); k > 0; --k) {
            const Vec3 d = random.direction();
            points.push_back(scale * (Vec3{d.x, 0.8 * d.y, thin * d.z} + shift));
        }
        const ConvexData body(points);
        const InnerBall& ball = body.ball;
        if (body.dimension < 3 || ball.radius == 0)
            continue; // flat, or too thin for an inner ball
        long double least = HUGE_VALL;
        for (const IndexTriangle& t : body.triangles)
            least = std::min(least, depth_below(body, t, ball.middle));
        EXPECT_LE(ball.radius, least) << i;
        // Rounding costs slivers more than this.
        if (least > 1e-3 * thin * scale) {
            EXPECT_GE(ball.radius, 0.99L * least) << i;
        }
        ++solid;
    }
    EXPECT_GT(solid, rounds * 9 / 10);
}

TEST(ConvexSearch, TheBallOfACubeIsTheLargest) {
    std::vector<Vec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i)
        corners.push_back({i & 1 ? 5.0 : 3.0, i & 2 ? 1.0 : -1.0, i & 4 ? 7.0 : 5.0});
    const ConvexData cube(corners);
    EXPECT_NEAR(cube.ball.radius, 1, 1e-10);
    EXPECT_NEAR(length(cube.ball.middle - Vec3{4, 0, 6}), 0, 1e-12);
    const std::vector<Vec3> square(corners.begin(), corners.begin() + 4);
    EXPECT_EQ(ConvexData(square).ball.radius, 0);
}

} // namespace
} // namespace test
} // namespace abut
#endif
