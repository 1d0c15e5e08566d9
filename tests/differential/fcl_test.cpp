// Models against the Flexible Collision Library, where it is installed. FCL decides in floating
// point without an error bound, so poses within rounding of contact are skipped.

#include <abut/rigid.h>

#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#ifdef ABUT_HAVE_FCL
#include "bench/peers/fcl_model.h"
#endif

namespace abut::test {
namespace {

#ifdef ABUT_HAVE_FCL

using bench::fcl_model;
using bench::fcl_transform;

std::vector<Mesh> meshes(Random& random) {
    return {
        torus_mesh(1, 0.35, 48, 24), sphere_mesh(0.9, 40, 24),
        grid_mesh(30, 30, false, false,
                  [](double u, double v) {
                      return Vec3{2 * u - 1, 2 * v - 1, 0.2 * std::sin(9 * u) * std::cos(5 * v)};
                  }),
        soup_mesh(random, 800, 0.8, 0.08), ring_mesh(-1, 1, 0.5, 0.7, 60)};
}

TEST(Fcl, AgreesOnContactAndDistance) {
    Random random(1301);
    int meet = 0, cases = 0, by_rounding = 0;
    double worst = 0;
    for (const Mesh& mesh_a : meshes(random))
        for (const Mesh& mesh_b : meshes(random)) {
            const Model a(mesh_a), b(mesh_b);
            const auto fcl_a = fcl_model<fcl::OBBRSSd>(mesh_a),
                       fcl_b = fcl_model<fcl::OBBRSSd>(mesh_b);
            for (int i = 0; i < 40; ++i) {
                const Transform world_a = random.pose(2);
                Transform world_b = random.pose(0);
                const Vec3 off = random.uniform(0.6, 2.6) * random.direction();
                world_b.m[9] = world_a.m[9] + off.x, world_b.m[10] = world_a.m[10] + off.y,
                world_b.m[11] = world_a.m[11] + off.z;
                const Gap gap = distance(a, world_a, b, world_b);
                fcl::CollisionRequestd collision_request;
                fcl::CollisionResultd collision;
                fcl::collide(fcl_a.get(), fcl_transform(world_a), fcl_b.get(),
                             fcl_transform(world_b), collision_request, collision);
                const bool ours = collide(a, world_a, b, world_b).meet();
                ASSERT_EQ(ours, gap.distance == 0);
                ++cases, meet += ours ? 1 : 0;
                if (ours != collision.isCollision()) {
                    // The libraries may differ only within rounding of contact.
                    ++by_rounding;
                    ASSERT_LT(gap.distance, 1e-7);
                    continue;
                }
                if (ours)
                    continue;
                fcl::DistanceRequestd request(true);
                request.rel_err = 0, request.abs_err = 0;
                fcl::DistanceResultd result;
                fcl::distance(fcl_a.get(), fcl_transform(world_a), fcl_b.get(),
                              fcl_transform(world_b), request, result);
                worst =
                    std::max(worst, std::abs(result.min_distance - gap.distance) / gap.distance);
                ASSERT_NEAR(result.min_distance, gap.distance, 1e-6 * gap.distance + 1e-12);
            }
        }
    std::cout << cases << " cases, " << meet << " meet, " << by_rounding
              << " differ within rounding; largest relative difference of distance " << worst
              << '\n';
    EXPECT_GT(meet, cases * 3 / 10);
    EXPECT_LT(meet, cases * 7 / 10);
    EXPECT_LT(by_rounding, cases / 100);
}

#else

TEST(Fcl, AgreesOnContactAndDistance) {
    GTEST_SKIP() << "libfcl-dev was not there when this was built";
}

#endif

} // namespace
} // namespace abut::test
