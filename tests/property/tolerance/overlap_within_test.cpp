// Proofs about a tolerance against samples: a depth that samples reach refutes "nowhere deeper", and
// where it is refuted, samples come near the tolerance.

#include "rigid/tolerance/overlap_within.h"
#include "tests/support/body.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

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

/// In          depth_at: of a point, in the solid.
template <typename Depth>
SampledDepth sampled_depth(const Body& surface, int n, const Depth& depth_at) {
    SampledDepth result;
    const auto count = static_cast<std::uint32_t>(surface.model.mesh().triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = surface.placed.world_triangle(i);
        const Vec3 u = (1.0 / n) * (t[1] - t[0]), v = (1.0 / n) * (t[2] - t[0]);
        result.spacing = std::max({result.spacing, length(u), length(v), length(u - v)});
        for (int j = 0; j <= n; ++j)
            for (int k = 0; j + k <= n; ++k)
                result.depth =
                    std::max(result.depth, depth_at(t[0] + double(j) * u + double(k) * v));
    }
    return result;
}

SampledDepth sampled_depth_in_convex(const Body& surface, const Body& solid, int n) {
    return sampled_depth(surface, n, [&](const Vec3& p) { return depth_in_convex(p, solid); });
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
        const SampledDepth in_b = sampled_depth_in_convex(a, b, 24),
                           in_a = sampled_depth_in_convex(b, a, 24);
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

/// A bound a u + b v + c s <= d on three unknowns.
struct Bound {
    double a, b, c, d;
};

/// The largest s that all bounds allow, by trying all corners. Negative if there are none.
double largest_third(const std::vector<Bound>& bounds) {
    double best = -1;
    const auto from = [&](std::size_t i, std::size_t j, std::size_t k) {
        const Vec3 p{bounds[i].a, bounds[i].b, bounds[i].c},
            q{bounds[j].a, bounds[j].b, bounds[j].c}, r{bounds[k].a, bounds[k].b, bounds[k].c};
        const double volume = dot(p, cross(q, r));
        if (std::abs(volume) < 1e-12)
            return;
        const Vec3 x = (1 / volume) * (bounds[i].d * cross(q, r) + bounds[j].d * cross(r, p) +
                                       bounds[k].d * cross(p, q));
        if (x.z > best && std::ranges::all_of(bounds, [&](const Bound& bound) {
                return bound.a * x.x + bound.b * x.y + bound.c * x.z <= bound.d + 1e-12;
            }))
            best = x.z;
    };
    for (std::size_t i = 2; i < bounds.size(); ++i)
        for (std::size_t j = 1; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k)
                from(i, j, k);
    return best;
}

/// The depth of the deepest point of a surface in a convex solid, by linear programs; both near the
/// origin.
double exact_depth(const Body& surface, const Body& solid) {
    std::vector<Vec3> normals;
    std::vector<double> offsets;
    const auto faces = static_cast<std::uint32_t>(solid.model.mesh().triangles.size());
    for (std::uint32_t i = 0; i < faces; ++i) {
        const Triangle t = solid.placed.world_triangle(i);
        const Vec3 normal =
            double(solid.placed.outward()) * normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        if (std::ranges::any_of(normals, [&](const Vec3& n) { return length(n - normal) < 1e-9; }))
            continue;
        normals.push_back(normal), offsets.push_back(dot(normal, t[0]));
    }
    double depth = 0;
    const auto count = static_cast<std::uint32_t>(surface.model.mesh().triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle t = surface.placed.world_triangle(i);
        std::vector<Bound> bounds{{-1, 0, 0, 0}, {0, -1, 0, 0}, {1, 1, 0, 1}};
        for (std::size_t j = 0; j < normals.size(); ++j)
            bounds.push_back({dot(normals[j], t[1] - t[0]), dot(normals[j], t[2] - t[0]), 1,
                              offsets[j] - dot(normals[j], t[0])});
        depth = std::max(depth, largest_third(bounds));
    }
    return depth;
}

/// A box or a prism, often thin, and often parallel to or flush with others.
Body some_block(Random& random) {
    const Vec3 half{random.uniform(0.2, 1), random.uniform(0.2, 1),
                    random.chance(0.3) ? random.uniform(0.01, 0.1) : random.uniform(0.2, 1)};
    Pose pose = random.chance(0.5) ? random.pose(0.7) : Pose{};
    if (random.chance(0.5))
        pose.translation = {0.25 * random.integer(-3, 3), 0.25 * random.integer(-3, 3),
                            random.uniform(-0.5, 0.5)};
    const Mesh mesh = random.chance(0.6)
                          ? box_mesh(-half, half)
                          : prism_mesh(-half.x, half.x, half.z, random.integer(3, 9));
    return Body(mesh, pose);
}

TEST(OverlapWithin, SolidDepthOfConvexSolidsIsExact) {
    Random random(20261128);
    const int rounds = many(400);
    int deep = 0, proven = 0;
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const Body a = some_block(random), b = some_block(random);
        const double depth = std::max(exact_depth(a, b), exact_depth(b, a));
        if (depth < 1e-3)
            continue;
        ++deep;
        const double known = random.chance(0.5) ? 0 : depth * random.uniform(0.1, 1.5);
        const SolidDepth found =
            solid_depth(a.placed, b.placed, {.tolerance = 1e-6, .budget = 20'000}, known);
        EXPECT_LE(found.depth, depth * (1 + 1e-9));
        EXPECT_GE(found.at_most, std::max(known, depth) * (1 - 1e-9));
        if (found.at_most == std::numeric_limits<double>::infinity())
            continue;
        ++proven;
        EXPECT_LE(found.at_most, std::max(known, depth) * (1 + 2e-6));
        if (known < depth * (1 - 1e-5)) {
            EXPECT_GE(found.depth, depth * (1 - 2e-6));
            EXPECT_NEAR(std::max(depth_in_convex(found.point, a), depth_in_convex(found.point, b)),
                        found.depth, 1e-9);
        }
    }
    EXPECT_GT(deep, rounds / 2);
    EXPECT_GT(proven, 0.95 * deep);
}

SampledDepth sampled_depth_in(const Body& surface, const Body& solid, int n) {
    return sampled_depth(surface, n, [&](const Vec3& p) {
        return solid.placed.contains(p) ? solid.placed.nearest(p, 1e9).distance : 0;
    });
}

TEST(OverlapWithin, SolidDepthAgainstSamples) {
    Random random(20261129);
    const int rounds = many(60);
    int deep = 0, proven = 0;
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        Pose pose = random.chance(0.5) ? random.pose(0.5) : Pose{};
        const Body a(make_solid(random, random.integer(0, kSolidKinds - 1)), {}),
            b(make_solid(random, random.integer(0, kSolidKinds - 1)), pose);
        const SampledDepth in_b = sampled_depth_in(a, b, 6), in_a = sampled_depth_in(b, a, 6);
        const double depth = std::max(in_b.depth, in_a.depth);
        const SolidDepth found =
            solid_depth(a.placed, b.placed, {.tolerance = 1e-6, .budget = 20'000}, 0);
        EXPECT_LE(found.depth, depth + std::max(in_b.spacing, in_a.spacing));
        EXPECT_GE(found.at_most, depth * (1 - 1e-9));
        if (found.at_most == std::numeric_limits<double>::infinity())
            continue;
        ++proven;
        EXPECT_GE(std::max(found.depth, 1e-6), depth * (1 - 2e-6));
        if (depth > 1e-6)
            ++deep;
    }
    EXPECT_GT(deep, rounds / 3);
    EXPECT_GT(proven, 0.9 * rounds);
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
