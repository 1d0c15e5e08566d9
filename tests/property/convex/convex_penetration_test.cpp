// Penetration of convex bodies against all planes that can bound the Minkowski difference.

#include <abut/convex.h>

#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

std::vector<Vec3> placed(const Convex& c, const Transform& world) {
    std::vector<Vec3> points;
    for (const Vec3& p : c.vertices())
        points.push_back(apply(world, p));
    return points;
}

/// The least n . b - n . a over all possible face normals of the Minkowski difference: the normals
/// of either body, and cross products of an edge of each.
double brute_depth(const Convex& a, const Transform& world_a, const Convex& b,
                   const Transform& world_b) {
    const std::vector<Vec3> pa = placed(a, world_a), pb = placed(b, world_b);
    double least = HUGE_VAL;
    const auto try_across = [&](const Vec3& u, const Vec3& v) {
        const Vec3 across = cross(normalized_or_zero(u), normalized_or_zero(v));
        if (length(across) < 1e-6) // parallel edges bound no face
            return;
        const Vec3 n = normalized_or_zero(across);
        double low_a = HUGE_VAL, high_a = -HUGE_VAL, low_b = HUGE_VAL, high_b = -HUGE_VAL;
        for (const Vec3& p : pa)
            low_a = std::min(low_a, dot(n, p)), high_a = std::max(high_a, dot(n, p));
        for (const Vec3& p : pb)
            low_b = std::min(low_b, dot(n, p)), high_b = std::max(high_b, dot(n, p));
        least = std::min({least, high_b - low_a, high_a - low_b});
    };
    const auto try_faces = [&](const Convex& c, const std::vector<Vec3>& p) {
        for (std::size_t f = 0; f < c.face_count(); ++f) {
            const auto face = c.face(f);
            try_across(p[face[1]] - p[face[0]], p[face[2]] - p[face[0]]);
        }
    };
    try_faces(a, pa);
    try_faces(b, pb);
    for (const auto& [i, j] : a.edges())
        for (const auto& [k, l] : b.edges())
            try_across(pa[j] - pa[i], pb[l] - pb[k]);
    return least;
}

std::vector<Vec3> make_points(Random& random, int kind) {
    std::vector<Vec3> points;
    switch (kind % 4) {
    case 0: {
        const int count = random.integer(4, 25);
        for (int i = 0; i < count; ++i)
            points.push_back(random.direction());
        return points;
    }
    case 1:
        return box_mesh({-0.7, -0.5, -0.4}, {0.7, 0.5, 0.4}).positions;
    case 2:
        for (int i = 0; i < 20; ++i)
            points.push_back(0.5 * (random.on_lattice(3) - Vec3{1.5, 1.5, 1.5}));
        return points;
    default: // a thin plate
        return prism_mesh(-0.01, 0.01, 0.8, random.integer(3, 12)).positions;
    }
}

TEST(ConvexPenetration, EqualsTheMinimumOverAllPlanes) {
    Random random(7101);
    int deep = 0, apart = 0;
    for (int i = 0; i < many(400); ++i) {
        const bool aligned = i % 4 == 0;
        const Convex a(make_points(random, i)), b(make_points(random, i / 4));
        const double scale = i % 5 == 0 ? 1e-5 : i % 7 == 0 ? 1e5 : 1;
        const Transform size = scaling(scale, scale, scale);
        Vec3 off = random.uniform(0, 1.3) * random.direction();
        if (aligned)
            off = {std::round(off.x * 4) / 4, std::round(off.y * 4) / 4, std::round(off.z * 4) / 4};
        const Transform world_a = compose(aligned ? Transform() : random.pose(0), size);
        Transform world_b = compose(aligned ? Transform() : random.pose(0), size);
        world_b.m[9] = scale * off.x, world_b.m[10] = scale * off.y, world_b.m[11] = scale * off.z;
        const ConvexDepth depth = penetration(a, world_a, b, world_b);
        ASSERT_EQ(depth.meet, distance(a, world_a, b, world_b).distance == 0) << i;
        if (!depth.meet) {
            EXPECT_EQ(depth.depth, 0);
            ++apart;
            continue;
        }
        const double rounding = 64 * 0x1p-52 * scale * 3;
        EXPECT_NEAR(depth.depth, brute_depth(a, world_a, b, world_b), rounding);
        EXPECT_LE(depth.at_least, depth.depth); // at_least is rounded down
        EXPECT_GE(depth.at_least, depth.depth - 4 * rounding);
        EXPECT_NEAR(length(depth.direction), 1, 1e-12);
        EXPECT_LE(length(depth.point_b + depth.depth * depth.direction - depth.point_a), rounding);
        const auto moved = [&](double by) {
            Transform t = world_b;
            t.m[9] += by * depth.direction.x, t.m[10] += by * depth.direction.y;
            t.m[11] += by * depth.direction.z;
            return distance(a, world_a, b, t).distance;
        };
        EXPECT_LE(moved(depth.depth * (1 - 1e-9)), rounding);
        EXPECT_NEAR(moved(depth.depth + 1e-3 * scale), 1e-3 * scale, rounding);
        deep += depth.depth > 1e-3 * scale ? 1 : 0;
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    EXPECT_GT(deep, 100);
    EXPECT_GT(apart, 20);
}

TEST(ConvexPenetration, AWarmStartChangesNothing) {
    Random random(7102);
    std::vector<Vec3> points;
    for (int i = 0; i < 300; ++i) {
        const Vec3 d = random.direction();
        points.push_back({d.x, 0.7 * d.y, 0.4 * d.z});
    }
    const Convex a(points), b(make_points(random, 0));
    ConvexWarmStart warm_start;
    int meet = 0, apart = 0;
    for (int path = 0; path < many(20); ++path) {
        Vec3 at = random.uniform(0, 2) * random.direction();
        Transform turn = random.pose(0);
        const Transform step = Pose{{}, {1, 0.01, 0.008 * random.uniform(-1, 1), 0.004}};
        for (int s = 0; s < 40; ++s) {
            turn = compose(step, turn);
            at = at + 0.02 * random.direction();
            Transform world_b = turn;
            world_b.m[9] = at.x, world_b.m[10] = at.y, world_b.m[11] = at.z;
            const ConvexDepth warm =
                penetration(a, Pose{}, b, world_b, {.warm_start = &warm_start});
            const ConvexDepth cold = penetration(a, Pose{}, b, world_b);
            ASSERT_EQ(warm.meet, cold.meet);
            ASSERT_NEAR(warm.depth, cold.depth, 1e-13);
            if (s % 5 == 0) { // a query of another kind in between
                const ConvexGap gap = distance(a, Pose{}, b, world_b, {.warm_start = &warm_start});
                ASSERT_EQ(gap.distance == 0, warm.meet);
            }
            (warm.meet ? meet : apart) += 1;
        }
    }
    EXPECT_GT(meet, 100);
    EXPECT_GT(apart, 30);
}

/// Bodies are brought to touch, then pushed into each other a little. Most of these depths are found
/// by walking; so this also tests the proof by inner balls. Maps may mirror, and a warm start serves
/// small steps and new poses.
TEST(ConvexPenetration, ShallowOverlapsEqualTheMinimumOverAllPlanes) {
    Random random(7104);
    int walked = 0, expanded = 0, warm_walked = 0;
    ConvexWarmStart warm_start;
    for (int i = 0; i < many(500); ++i) {
        const Convex a(make_points(random, i)), b(make_points(random, i / 4));
        const double scale = i % 5 == 0 ? 1e-5 : i % 7 == 0 ? 1e5 : 1;
        const Transform world_a = compose(random.pose(0), scaling(scale, scale, scale));
        const double mirror = i % 3 == 0 ? -1 : 1;
        Transform world_b = compose(random.pose(0), scaling(mirror * scale, scale, 1.3 * scale));
        const Vec3 away = 4 * scale * random.direction();
        world_b.m[9] += away.x, world_b.m[10] += away.y, world_b.m[11] += away.z;
        const ConvexGap gap = distance(a, world_a, b, world_b);
        ASSERT_GT(gap.distance, 0);
        const double in = scale * std::pow(10, random.uniform(-7, -0.7));
        const Vec3 back = (1 + in / gap.distance) * (gap.point_a - gap.point_b);
        world_b.m[9] += back.x, world_b.m[10] += back.y, world_b.m[11] += back.z;
        for (int step = 0; step < 3; ++step) {
            if (step > 0)
                world_b.m[9 + static_cast<std::size_t>(step)] += 1e-3 * scale;
            const ConvexDepth cold = penetration(a, world_a, b, world_b),
                              warm =
                                  penetration(a, world_a, b, world_b, {.warm_start = &warm_start});
            ASSERT_EQ(cold.meet, warm.meet) << i;
            ASSERT_EQ(cold.meet, distance(a, world_a, b, world_b).distance == 0) << i;
            if (!cold.meet)
                continue;
            const double truth = brute_depth(a, world_a, b, world_b),
                         rounding = 64 * 0x1p-52 * scale * 6;
            for (const ConvexDepth& depth : {cold, warm}) {
                EXPECT_NEAR(depth.depth, truth, rounding) << i;
                EXPECT_LE(depth.at_least, depth.depth) << i;
                EXPECT_GE(depth.at_least, depth.depth - rounding) << i;
                EXPECT_LE(length(depth.point_b + depth.depth * depth.direction - depth.point_a),
                          rounding)
                    << i;
            }
            (cold.counters.simplices == 0 ? walked : expanded) += 1;
            warm_walked += step > 0 && warm.counters.simplices == 0 ? 1 : 0;
        }
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    EXPECT_GT(walked, many(200));
    EXPECT_GT(expanded, many(50));
    EXPECT_GT(warm_walked, many(150));
}

/// One warm start serves random bodies of all kinds in turn, in steps of all sizes. The cached
/// polytope may be dented or inside out, or may not belong to these bodies at all.
TEST(ConvexPenetration, AWarmStartOfOtherBodiesChangesNothing) {
    Random random(7103);
    ConvexWarmStart warm_start;
    int meet = 0;
    std::uint64_t warm_simplices = 0, cold_simplices = 0;
    for (int i = 0; i < many(150); ++i) {
        const Convex a(make_points(random, i)), b(make_points(random, i / 4));
        Transform turn = random.pose(0);
        Vec3 at = random.uniform(0, 1) * random.direction();
        const double size = std::pow(10, random.uniform(-5, -0.3));
        for (int s = 0; s < 12; ++s) {
            const Vec3 axis = size * random.direction();
            turn = compose(Pose{{}, {1, axis.x, axis.y, axis.z}}, turn);
            at = at + size * random.direction();
            Transform world_b = turn;
            world_b.m[9] = at.x, world_b.m[10] = at.y, world_b.m[11] = at.z;
            const ConvexDepth warm = penetration(a, {}, b, world_b, {.warm_start = &warm_start});
            const ConvexDepth cold = penetration(a, {}, b, world_b);
            const double rounding = 64 * 0x1p-52 * 3;
            ASSERT_NEAR(warm.depth, cold.depth, rounding) << i << ' ' << s;
            ASSERT_NEAR(warm.at_least, warm.depth, rounding) << i << ' ' << s;
            ASSERT_LE(length(warm.point_b + warm.depth * warm.direction - warm.point_a), rounding);
            if (warm.depth > rounding) {
                ASSERT_TRUE(cold.meet);
            }
            if (cold.depth > rounding) {
                ++meet;
                warm_simplices += warm.counters.simplices;
                cold_simplices += cold.counters.simplices;
            }
        }
    }
    EXPECT_GT(meet, many(150) * 4);
    EXPECT_LT(2 * warm_simplices, cold_simplices);
}

} // namespace
} // namespace abut::test
