// Hulls of real meshes that overlap or are apart by very little: convex queries agree with the
// triangles.

#include <abut/convex.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

class ShallowOverlaps : public testing::TestWithParam<const char*> {};

/// The hull of a mesh, scaled to a diagonal of 2 and centred at the origin.
Convex hull_of(const std::string& file) {
    Mesh mesh = read_mesh(file);
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, p);
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    const double scale = 2 / length(box.upper - box.lower);
    for (Vec3& p : mesh.positions)
        p = scale * (p - middle);
    return Convex(mesh.positions);
}

TEST_P(ShallowOverlaps, AreFoundForHullsOfMeshes) {
    const std::string file = std::string(ABUT_SHARED_DATA) + "/meshes/" + GetParam();
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is not there";
    const Convex body = hull_of(file);
    const Model surface(body.mesh());
    Random random(7400);
    ConvexWarmStart warm_start;
    int shallow = 0, apart = 0;
    const int cases = many(150);
    for (int i = 0; i < cases; ++i) {
        const Transform world_a = random.pose(0);
        Transform world_b = random.pose(0.2);
        const ConvexDepth deep = penetration(body, world_a, body, world_b);
        ASSERT_TRUE(deep.meet);
        const double left = std::pow(10, random.uniform(-8, -2)) * (i % 4 == 0 ? -1 : 1);
        const double by = deep.depth - left;
        world_b.m[9] += by * deep.direction.x, world_b.m[10] += by * deep.direction.y;
        world_b.m[11] += by * deep.direction.z;
        const bool meets = left > 0;
        ASSERT_EQ(collide(surface, world_a, surface, world_b).meet(), meets) << i;
        for (ConvexWarmStart* w : {static_cast<ConvexWarmStart*>(nullptr), &warm_start}) {
            const ConvexGap gap = distance(body, world_a, body, world_b, {.warm_start = w});
            const ConvexDepth depth = penetration(body, world_a, body, world_b, {.warm_start = w});
            ASSERT_EQ(gap.distance == 0, meets) << i << ' ' << left;
            ASSERT_EQ(depth.meet, meets) << i << ' ' << left;
            ASSERT_EQ(gap.status, Status::exact);
            ASSERT_EQ(depth.status, Status::exact);
            if (meets) {
                ASSERT_GT(depth.depth, 0);
                ASSERT_LE(depth.at_least, left + 1e-14);
            } else {
                ASSERT_NEAR(gap.distance, -left, 1e-14);
                ASSERT_GT(gap.at_least, 0);
            }
        }
        ++(meets ? shallow : apart);
    }
    EXPECT_GT(shallow, cases / 2);
    EXPECT_GT(apart, cases / 8);
}
INSTANTIATE_TEST_SUITE_P(Meshes, ShallowOverlaps,
                         testing::Values("armadillo.obj", "fandisk.obj", "rocker-arm.obj",
                                         "stanford-bunny.obj"));

} // namespace
} // namespace abut::test
