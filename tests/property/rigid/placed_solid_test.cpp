#include "geometry/point_triangle_distance.h"
#include "tests/support/body.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Transform any_placement(Random& random) {
    const double mirror = random.chance(0.5) ? -1 : 1;
    return compose(random.pose(1000),
                   Transform({mirror * random.uniform(0.3, 3), 0.2, 0, 0, random.uniform(0.3, 3),
                              0.1, 0, 0, random.uniform(0.3, 3), 0, 0, 0}));
}

/// Checks contains() at random points. `depth_of` is positive inside the smooth solid; points
/// within `band` of its surface are skipped.
template <typename DepthOf>
void check_contains(Random& random, const Mesh& mesh, double half, double band,
                    const DepthOf& depth_of) {
    int inside = 0, asked = 0;
    for (int placement = 0; placement < 10; ++placement) {
        const Body body(placement % 2 == 0 ? mesh : reversed(mesh), any_placement(random));
        ASSERT_TRUE(body.solid.closed);
        for (int i = 0; i < 400; ++i) {
            const Vec3 p = random.in_cube(half);
            const double depth = depth_of(p);
            if (std::abs(depth) < band)
                continue;
            const Vec3 world = apply(body.placed.model().world(), p);
            ASSERT_EQ(body.placed.contains(world), depth > 0);
            ASSERT_EQ(body.placed.winds_around(world), depth > 0);
            ++asked, inside += depth > 0 ? 1 : 0;
        }
        for (int i = 0; i < 50; ++i) {
            const auto v =
                static_cast<std::uint32_t>(random.integer(0, int(mesh.positions.size()) - 1));
            ASSERT_TRUE(body.placed.on_surface(body.placed.model().world_vertex(v)));
            ASSERT_FALSE(body.placed.contains(body.placed.model().world_vertex(v)));
        }
    }
    EXPECT_GT(inside, asked / 10);
    EXPECT_LT(inside, asked * 9 / 10);
}

TEST(PlacedSolid, ContainsInASphere) {
    Random random(1101);
    check_contains(random, sphere_mesh(1, 40, 20), 1.2, 0.02,
                   [](const Vec3& p) { return 1 - length(p); });
}

TEST(PlacedSolid, ContainsInATorus) {
    Random random(1102);
    check_contains(random, torus_mesh(1, 0.5, 40, 20), 1.6, 0.02, [](const Vec3& p) {
        const double ring = std::hypot(p.x, p.y) - 1;
        return 0.5 - std::hypot(ring, p.z);
    });
}

TEST(PlacedSolid, NearestEqualsAllTriangles) {
    Random random(1103);
    for (int i = 0; i < 200; ++i) {
        const Mesh mesh = torus_mesh(1, 0.5, 14, 9);
        const Body body(mesh, any_placement(random));
        const Vec3 p = apply(body.placed.model().world(), random.in_cube(2));
        double expected = HUGE_VAL;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            expected = std::min(
                expected,
                std::sqrt(point_triangle_distance(p, body.placed.world_triangle(t)).distance_sq));
        const PlacedSolid::Nearest n = body.placed.nearest(p, HUGE_VAL);
        ASSERT_NEAR(n.distance, expected, 1e-12);
        ASSERT_NEAR(length(n.point - p), expected, 1e-11);
        ASSERT_EQ(body.placed.nearest(p, 0.9 * expected).distance, HUGE_VAL);
        ASSERT_NEAR(body.placed.nearest(p, 1.1 * expected).distance, expected, 1e-12);
    }
}

/// Boxes on a grid, where it is obvious whether interiors overlap.
TEST(Interpenetrate, BoxesOnAGrid) {
    Random random(1104);
    int meet = 0, go_in = 0, shared_faces = 0;
    for (int i = 0; i < 1500; ++i) {
        const auto make = [&](Vec3& low, Vec3& high) {
            low = random.on_lattice(3);
            const Vec3 size = random.on_lattice(2);
            high = low + size + Vec3{1, 1, 1};
        };
        Vec3 a_low, a_high, b_low, b_high;
        make(a_low, a_high), make(b_low, b_high);
        const Body a(box_mesh(a_low, a_high)),
            b(random.chance(0.5) ? box_mesh(b_low, b_high) : reversed(box_mesh(b_low, b_high)));
        const Vec3 low = max(a_low, b_low), high = min(a_high, b_high);
        const bool overlap = low.x < high.x && low.y < high.y && low.z < high.z;
        const Meeting m = meeting(a, b);
        if (m.contacts.empty())
            continue;
        ++meet, go_in += overlap ? 1 : 0;
        const bool crosses =
            std::any_of(m.contacts.begin(), m.contacts.end(),
                        [](const Contact& c) { return c.kind == TriangleContact::cross; });
        shared_faces += overlap && !crosses ? 1 : 0;
        ASSERT_EQ(m.go_in, overlap) << i;
        if (overlap) {
            ASSERT_GT(m.depth.depth, 0) << i;
            ASSERT_GE(m.depth.at_most, m.depth.depth);
        }
    }
    EXPECT_GT(go_in, meet * 3 / 10);
    EXPECT_LT(go_in, meet * 9 / 10);
    EXPECT_GT(shared_faces, 20);
}

} // namespace
} // namespace abut::test
