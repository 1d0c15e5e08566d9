// collide, distance and within against all pairs of triangles.

#include <abut/error.h>
#include <abut/rigid.h>

#include "tests/support/oracle/brute_force.h"
#include "tests/support/shapes.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

enum class RigidPlacement { rigid, affine, far, flattened, rigid_on_grid };

Mesh make_pair_mesh(Random& random, int kind) {
    switch (kind) {
    case 0:
        return torus_mesh(1, 0.35, 12, 7);
    case 1:
        return sphere_mesh(0.9, 9, 6);
    case 2: // open
        return grid_mesh(9, 9, false, false, [](double u, double v) {
            return Vec3{2 * u - 1, 2 * v - 1, 0.2 * std::sin(9 * u) * std::cos(5 * v)};
        });
    case 3:
        return soup_mesh(random, 120, 0.7, 0.2);
    default:
        return with_degenerates(
            random,
            joined(box_mesh({-0.7, -0.6, -0.5}, {0.7, 0.6, 0.5}), soup_mesh(random, 20, 0.7, 0.2)),
            12);
    }
}

Transform place(Random& random, RigidPlacement kind, const Vec3& at) {
    Transform t = random.pose(0);
    if (kind == RigidPlacement::rigid_on_grid) // a quarter turn on a grid gives exact contacts
        t = Transform({0, 1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0});
    if (kind == RigidPlacement::affine)
        t = compose(t, Transform({random.chance(0.5) ? -1.3 : 1.3, random.uniform(-0.5, 0.5), 0,
                                  random.uniform(-0.5, 0.5), random.uniform(0.5, 1.5), 0, 0,
                                  random.uniform(-0.5, 0.5), random.uniform(0.5, 1.5), 0, 0, 0}));
    if (kind == RigidPlacement::flattened)
        t = compose(t, scaling(1, 1, random.chance(0.5) ? 0 : 1));
    t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
    return t;
}

struct PairCase {
    Model a, b;
    Transform world_a, world_b;
};

double largest_coordinate(const std::vector<PlacedTriangle>& triangles) {
    double m = 0;
    for (const PlacedTriangle& t : triangles)
        for (const Vec3& p : t.corners)
            m = std::max({m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return m;
}

/// Checks all queries. Returns whether the models meet.
bool check(const PairCase& c) {
    const auto a = placed_triangles(c.a.mesh(), c.world_a),
               b = placed_triangles(c.b.mesh(), c.world_b);
    const std::vector<TrianglePair> pairs = brute_pairs(a, b);
    const Contacts all = collide(c.a, c.world_a, c.b, c.world_b, {.mode = ContactMode::all});
    EXPECT_EQ(all.pairs, pairs);
    const Contacts first = collide(c.a, c.world_a, c.b, c.world_b);
    EXPECT_EQ(first.pairs.size(), pairs.empty() ? 0U : 1U);
    if (first.meet()) {
        EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), first.pairs[0]));
    }
    std::vector<TrianglePair> swapped;
    for (const TrianglePair& p :
         collide(c.b, c.world_b, c.a, c.world_a, {.mode = ContactMode::all}).pairs)
        swapped.push_back({p.b, p.a});
    std::sort(swapped.begin(), swapped.end());
    EXPECT_EQ(swapped, pairs);

    const double expected = pairs.empty() ? brute_distance(a, b) : 0;
    const Gap gap = distance(c.a, c.world_a, c.b, c.world_b);
    const double grid = 0x1p-53 * std::max(largest_coordinate(a), largest_coordinate(b));
    EXPECT_NEAR(gap.distance, expected, 16 * 0x1p-53 * 4);
    EXPECT_EQ(gap.distance == 0, !pairs.empty());
    EXPECT_EQ(gap.status, Status::exact);
    EXPECT_LE(
        std::sqrt(point_triangle_distance(gap.point_a, a[gap.triangle_a].corners).distance_sq),
        32 * grid);
    EXPECT_LE(
        std::sqrt(point_triangle_distance(gap.point_b, b[gap.triangle_b].corners).distance_sq),
        32 * grid);
    EXPECT_NEAR(length(gap.point_a - gap.point_b), expected, 32 * grid);
    EXPECT_NEAR(distance(c.b, c.world_b, c.a, c.world_a).distance, expected, 16 * 0x1p-53 * 4);

    const auto near = [&](double tolerance) {
        return within(c.a, c.world_a, c.b, c.world_b, tolerance);
    };
    EXPECT_EQ(near(0), !pairs.empty());
    EXPECT_TRUE(near(expected * (1 + 1e-12) + 1e-14));
    EXPECT_TRUE(near(3 * expected + 1));
    if (expected > 1e-12) {
        EXPECT_FALSE(near(expected * (1 - 1e-12) - 1e-14));
        EXPECT_FALSE(near(0.3 * expected));
        const Gap bounded = distance(c.a, c.world_a, c.b, c.world_b, {.upper_bound = 2 * expected});
        EXPECT_NEAR(bounded.distance, expected, 16 * 0x1p-53 * 4);
        EXPECT_EQ(bounded.status, Status::exact);
        const Gap cut = distance(c.a, c.world_a, c.b, c.world_b, {.upper_bound = expected / 2});
        EXPECT_EQ(cut.distance, expected / 2);
        EXPECT_EQ(cut.status, Status::bound_only);
    }
    return !pairs.empty();
}

class Rigid : public testing::TestWithParam<RigidPlacement> {};

TEST_P(Rigid, EqualsBruteForce) {
    const RigidPlacement placement = GetParam();
    Random random(1000 + static_cast<std::uint64_t>(placement));
    int meet = 0, cases = 0;
    for (int kind_a = 0; kind_a < 5; ++kind_a)
        for (int kind_b = 0; kind_b < 5; ++kind_b)
            for (int i = 0; i < 8; ++i, ++cases) {
                const Vec3 at =
                    placement == RigidPlacement::far ? random.in_cube(1e5) : random.in_cube(3);
                const double reach = placement == RigidPlacement::rigid    ? 2.7
                                     : placement == RigidPlacement::affine ? 3.1
                                                                           : 2.6;
                Vec3 off = random.uniform(0.6, reach) * random.direction();
                if (placement == RigidPlacement::rigid_on_grid)
                    off = {std::round(off.x * 4) / 4, std::round(off.y * 4) / 4,
                           std::round(off.z * 4) / 4};
                const PairCase c{Model(make_pair_mesh(random, kind_a)),
                                 Model(make_pair_mesh(random, kind_b)),
                                 place(random, placement, at), place(random, placement, at + off)};
                meet += check(c) ? 1 : 0;
                ASSERT_FALSE(HasFailure()) << "kinds " << kind_a << ' ' << kind_b << ", case " << i;
            }
    EXPECT_GT(meet, cases * 3 / 10);
    EXPECT_LT(meet, cases * 7 / 10);
}
INSTANTIATE_TEST_SUITE_P(Placements, Rigid,
                         testing::Values(RigidPlacement::rigid, RigidPlacement::affine,
                                         RigidPlacement::far, RigidPlacement::flattened,
                                         RigidPlacement::rigid_on_grid));

TEST(Rigid, EverySimdTargetAgrees) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(1010);
        int meet = 0;
        for (int i = 0; i < 30; ++i) {
            const auto placement = i % 2 == 0 ? RigidPlacement::rigid : RigidPlacement::affine;
            const PairCase c{
                Model(make_pair_mesh(random, i % 5)), Model(make_pair_mesh(random, i / 5 % 5)),
                place(random, placement, {}),
                place(random, placement, random.uniform(0.6, 2.2) * random.direction())};
            meet += check(c) ? 1 : 0;
        }
        EXPECT_GT(meet, 5);
        EXPECT_LT(meet, 25);
    });
}

TEST(Rigid, CoincidentModels) {
    Random random(1011);
    for (int kind = 0; kind < 5; ++kind) {
        const Model m(make_pair_mesh(random, kind));
        const Transform t = place(random, RigidPlacement::affine, random.in_cube(5));
        EXPECT_TRUE(check({m, m, t, t}));
    }
}

TEST(Rigid, ACommonMotionChangesNothing) {
    Random random(1012);
    int apart = 0;
    for (int i = 0; i < 60; ++i) {
        const Model a(make_pair_mesh(random, i % 5)), b(make_pair_mesh(random, i / 5 % 5));
        const Transform world_a = random.pose(1),
                        world_b = compose(translation(random.uniform(1, 3), 0, 0), random.pose(1));
        const double before = distance(a, world_a, b, world_b).distance;
        const Transform motion = random.pose(100);
        const double after =
            distance(a, compose(motion, world_a), b, compose(motion, world_b)).distance;
        ASSERT_NEAR(before, after, 1e-12);
        apart += before > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 15);
    EXPECT_LT(apart, 60);
}

TEST(Rigid, ScalesOfMillionthsAndMillions) {
    Random random(1013);
    for (const double scale : {1e-6, 1e6, 1e-15, 1e15}) {
        int meet = 0;
        for (int i = 0; i < 25; ++i) {
            const Mesh mesh_a = make_pair_mesh(random, i % 5),
                       mesh_b = make_pair_mesh(random, i / 5);
            const Transform world_a = random.pose(0), scaled = scaling(scale, scale, scale);
            Transform world_b = random.pose(0);
            const Vec3 off = random.uniform(0.6, 2.2) * random.direction();
            world_b.m[9] = off.x, world_b.m[10] = off.y, world_b.m[11] = off.z;
            const Model a(mesh_a), b(mesh_b), a_scaled(transformed(mesh_a, scaled)),
                b_scaled(transformed(mesh_b, scaled));
            const double plain = distance(a, world_a, b, world_b).distance;
            // Scales the meshes, and then the transforms instead.
            Transform at_scale = world_b;
            for (std::size_t k = 9; k < 12; ++k)
                at_scale.m[k] *= scale;
            ASSERT_NEAR(distance(a_scaled, world_a, b_scaled, at_scale).distance / scale, plain,
                        1e-13);
            ASSERT_NEAR(
                distance(a, compose(scaled, world_a), b, compose(scaled, world_b)).distance / scale,
                plain, 1e-13);
            meet += plain == 0 ? 1 : 0;
        }
        EXPECT_GT(meet, 4);
        EXPECT_LT(meet, 23);
    }
}

} // namespace
} // namespace abut::test
