// Signed distance, by hand and along a path that enters and leaves a solid.

#include "rigid/signed_gap.h"
#include "tests/support/body.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Gap gap(const Body& a, const Body& b, const Transform& world_b, double accuracy = 0.01) {
    return signed_gap(a.model, {}, b.model, world_b, {}, accuracy);
}

TEST(SignedGap, ByHand) {
    const Body box(box_mesh({0, 0, 0}, {1, 1, 1})),
        small(box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})),
        sheet(Mesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}, {{0, 1, 2}}});
    EXPECT_EQ(gap(box, box, translation(3, 0, 0)).distance, 2);
    EXPECT_EQ(gap(box, box, translation(1, 0, 0)).distance, 0);
    EXPECT_NEAR(gap(box, box, {}).distance, -1, 1e-6); // they coincide: no point lies inside the
                                                       // other
    EXPECT_NEAR(gap(box, small, translation(0.65, 0, 0)).distance, -0.1, 1e-3);
    EXPECT_NEAR(gap(box, small, {}).distance, -0.5, 6e-3); // its corner is half a unit deep
    EXPECT_NEAR(gap(small, box, {}).distance, -0.5, 6e-3);
    EXPECT_EQ(gap(sheet, sheet, translation(0, 0, 1)).distance, 1);
    EXPECT_EQ(gap(sheet, sheet, translation(0, 0, 0)).distance, 0);
    EXPECT_EQ(gap(box, box, scaling(1, 1, 0)).distance, 0);
    const Gap in = gap(box, small, translation(0.65, 0, 0));
    EXPECT_NEAR(length(in.point_a - in.point_b), 0.1, 1e-3);
    EXPECT_EQ(in.point_a.x, 1);
    for (const std::uint32_t v : box.model.mesh().triangles[in.triangle_a])
        EXPECT_EQ(box.model.mesh().positions[v].x, 1);
}

/// The distance changes by no more than the motion, also where contact begins or ends.
TEST(SignedGap, ChangesNoFasterThanTheModelMoves) {
    Random random(3301);
    const Body torus(torus_mesh(1, 0.5, 30, 16)), ball(sphere_mesh(0.3, 14, 8));
    int inside = 0, across = 0, outside = 0;
    for (int path = 0; path < 8; ++path) {
        // The path leads anywhere, or to the middle of the tube.
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const Vec3 from = 1.9 * random.direction(),
                   to = path % 2 == 0 ? random.in_cube(1.5)
                                      : Vec3{std::cos(angle), std::sin(angle), 0};
        const Transform turn = random.pose(0);
        constexpr int kSteps = 60;
        double before = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const Vec3 at = from + (double(i) / kSteps) * (to - from);
            Transform world = turn;
            world.m[9] = at.x, world.m[10] = at.y, world.m[11] = at.z;
            const double now = gap(torus, ball, world, 1e-3).distance;
            const double step = length(to - from) / kSteps;
            if (i > 0) {
                ASSERT_LE(std::abs(now - before), step + 2e-3 * std::abs(now) + 1e-9);
            }
            const bool meet = collide(torus.model, {}, ball.model, world).meet();
            inside += now < 0 && !meet ? 1 : 0, across += meet ? 1 : 0, outside += now > 0 ? 1 : 0;
            before = now;
        }
    }
    EXPECT_GT(inside, 3);
    EXPECT_GT(across, 50);
    EXPECT_GT(outside, 50);
}

} // namespace
} // namespace abut::test
