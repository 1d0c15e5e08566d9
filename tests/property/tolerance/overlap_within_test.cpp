// Proofs about a tolerance against samples: a depth that samples reach refutes "nowhere deeper", and
// where it is refuted, samples come near the tolerance.

#include "rigid/tolerance/overlap_within.h"
#include "tests/support/body.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

/// A convex solid, so that the depth of a point is its least distance from the planes of the faces.
Mesh some_convex(Random& random) {
    const Vec3 half{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    switch (random.integer(0, 2)) {
    case 0:
        return box_mesh(-half, half);
    case 1:
        return prism_mesh(-half.x, half.x, half.y, random.integer(3, 12));
    default:
        return sphere_mesh(half.x, random.integer(4, 12), random.integer(3, 8));
    }
}

double depth_in_convex(const Vec3& point, const Body& solid) {
    double depth = std::numeric_limits<double>::infinity();
    const auto count = static_cast<std::uint32_t>(solid.model.mesh().triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = solid.placed.world_triangle(i);
        const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        depth = std::min(depth, double(solid.placed.outward()) * dot(t[0] - point, normal));
    }
    return depth;
}

/// The largest depth of points of a surface's faces on a grid, and how far such points are apart.
struct SampledDepth {
    double depth = 0, spacing = 0;
};

SampledDepth sampled_depth(const Body& surface, const Body& solid, int n) {
    SampledDepth result;
    const auto count = static_cast<std::uint32_t>(surface.model.mesh().triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = surface.placed.world_triangle(i);
        const Vec3 u = (1.0 / n) * (t[1] - t[0]), v = (1.0 / n) * (t[2] - t[0]);
        result.spacing = std::max({result.spacing, length(u), length(v), length(u - v)});
        for (int j = 0; j <= n; ++j)
            for (int k = 0; j + k <= n; ++k)
                result.depth = std::max(
                    result.depth, depth_in_convex(t[0] + double(j) * u + double(k) * v, solid));
    }
    return result;
}

TEST(OverlapWithin, DepthsOfConvexSolidsAgainstSamples) {
    Random random(2027);
    const int rounds = many(250);
    int held = 0, failed = 0, met = 0;
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const double away = random.chance(0.3) ? 1e5 : 0;
        const Vec3 shift{away, -away, away};
        // Often parallel, and then with a face nearly flush.
        Pose pose = random.chance(0.5) ? random.pose(0) : Pose{};
        pose.translation = shift;
        const Body a(some_convex(random), pose);
        Pose other = random.chance(0.5) ? random.pose(0) : pose;
        other.translation = shift + random.in_cube(1);
        const Body b(some_convex(random), other);
        const SampledDepth in_b = sampled_depth(a, b, 24), in_a = sampled_depth(b, a, 24);
        const double depth = std::max(in_b.depth, in_a.depth),
                     spacing = std::max(in_b.spacing, in_a.spacing);
        if (!(depth > 1e-3))
            continue;
        ++met;
        const double t = depth * random.uniform(0.7, 1.3);
        const Proof proof = nowhere_deeper(a.placed, b.placed, {t});
        EXPECT_EQ(nowhere_deeper(b.placed, a.placed, {t}), proof);
        if (proof == Proof::holds) {
            EXPECT_LE(depth, t + 1e-9);
            ++held;
        } else {
            EXPECT_EQ(proof, Proof::fails);
            EXPECT_GE(depth + spacing, t);
            ++failed;
        }
    }
    EXPECT_GT(met, rounds / 3);
    EXPECT_GT(held, met / 8);
    EXPECT_GT(failed, met / 8);
}

/// The diameter of the largest ball in two boxes with parallel sides: the least side of the common
/// box.
TEST(OverlapWithin, ThicknessOfParallelBoxes) {
    Random random(41);
    const int rounds = many(300);
    int held = 0, failed = 0;
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const Vec3 half_a{random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)},
            half_b{random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)};
        Vec3 by = random.in_cube(1.5);
        if (random.chance(0.4)) // flush at the upper end of x
            by.x = half_a.x - half_b.x;
        if (random.chance(0.3))
            by.z = half_b.z - half_a.z;
        const Vec3 common = min(half_a, by + half_b) - max(-half_a, by - half_b);
        const double thickness = std::min({common.x, common.y, common.z});
        if (!(thickness > 0.01))
            continue;
        const Transform world = random.chance(0.5) ? Transform{} : Transform(random.pose(3));
        const Body a(box_mesh(-half_a, half_a), world),
            b(box_mesh(by - half_b, by + half_b), world);
        const bool within = random.chance(0.5);
        const double t =
            thickness * (within ? random.uniform(1.02, 1.5) : random.uniform(0.4, 0.99));
        EXPECT_EQ(nowhere_thicker(a.placed, b.placed, {t}), within ? Proof::holds : Proof::fails)
            << t / thickness;
        ++(within ? held : failed);
    }
    EXPECT_GT(held, rounds / 5);
    EXPECT_GT(failed, rounds / 5);
}

TEST(OverlapWithin, CopiesMovedByLessAreNear) {
    Random random(8);
    for (int round = 0; round < many(100); ++round) {
        SCOPED_TRACE(round);
        const Mesh mesh = some_convex(random);
        const Transform world(random.pose(2));
        const double t = std::pow(10.0, random.uniform(-6, -1));
        const Vec3 direction = random.direction();
        const auto moved = [&](double by) {
            Mesh copy = mesh;
            for (Vec3& p : copy.positions)
                p = p + by * direction;
            return copy;
        };
        const Body body(mesh, world), near(moved(0.99 * t), world), far(moved(3 * t), world);
        EXPECT_EQ(everywhere_near(body.placed, near.placed, {t}), Proof::holds);
        EXPECT_EQ(everywhere_near(body.placed, far.placed, {t}), Proof::fails);
    }
}

} // namespace
} // namespace abut::test
