// The triangle of a model that is nearest to a triangle, against all of them, and what it costs to
// find. Each test prints its seed and what it has seen.

#include <abut/surface_contacts.h>

#include "deform/bodies/model_triangles.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/transform.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <optional>
#include <vector>

namespace abut::test {
namespace {

/// The triangles of a placed model, one by one.
std::vector<Triangle> world_triangles(const Model& model, const Transform& world) {
    std::vector<Triangle> all;
    const Mesh& mesh = model.mesh();
    for (const auto& t : mesh.triangles)
        all.push_back({apply(world, mesh.positions[t[0]]), apply(world, mesh.positions[t[1]]),
                       apply(world, mesh.positions[t[2]])});
    return all;
}

/// A triangle of a size between a thousandth and a thousand, beside a point, and sometimes a
/// needle.
Triangle triangle_at(Random& random, const Vec3& point) {
    const double size = std::pow(10, random.uniform(-3, 3));
    const double narrow = random.chance(0.3) ? std::pow(10, -random.uniform(1, 12)) : 1;
    const Vec3 along = size * random.direction(), aside = narrow * size * random.direction();
    const double s = random.uniform(0, 1), r = random.uniform(0, 1 - s);
    const Vec3 first = point - s * along - r * aside;
    return {first, first + along, first + aside};
}

Model any_model(Random& random, double& edge) {
    const int kind = random.integer(0, 4);
    edge = kind == 0 ? 0.2 : 0.1;
    if (kind == 4)
        return Model(needle_soup(random, random.integer(1, 60)).mesh);
    if (kind == 0)
        return Model(soup_mesh(random, random.integer(1, 300), 1, 0.2));
    if (kind == 1)
        return Model(sphere_mesh(1, random.integer(4, 24), random.integer(3, 16)));
    if (kind == 2)
        return Model(torus_mesh(1, 0.3, random.integer(6, 20), random.integer(4, 12)));
    return Model(transformed(box_mesh({-1, -1e-3, -0.5}, {1, 1e-3, 0.5}), translation(3e3, 0, 7)));
}

TEST(ModelTriangles, NearestAgainstAllTriangles) {
    Random random(20261);
    std::size_t apart = 0, meet = 0, beyond = 0;
    for (int round = 0; round < many(60); ++round) {
        double edge = 0;
        const Model model = any_model(random, edge);
        Pose pose = random.pose(1);
        if (random.chance(0.2))
            pose.translation = pose.translation + Vec3{1e5, -3e4, 10};
        const Transform world = pose;
        const std::vector<Triangle> all = world_triangles(model, world);
        const ModelTriangles triangles(model, world);
        for (int k = 0; k < 20; ++k) {
            const Triangle& any = all[std::size_t(random.integer(0, int(all.size()) - 1))];
            const Vec3 off = random.chance(0.3) ? Vec3{} : edge * random.in_cube(2);
            const Triangle t = triangle_at(random, any[0] + off);
            double least = std::numeric_limits<double>::infinity();
            for (const Triangle& other : all)
                least =
                    std::min(least, std::sqrt(triangle_triangle_distance(t, other).distance_sq));
            const double limit = random.chance(0.3) ? 0 : random.uniform(0, 2 * edge);
            const auto found = triangles.nearest_to(t, limit);
            ASSERT_EQ(found.has_value(), least <= limit) << round << ' ' << k;
            if (!found) {
                ++beyond;
                continue;
            }
            ASSERT_EQ(std::sqrt(found->closest.distance_sq), least);
            ASSERT_EQ(triangle_triangle_distance(t, all[found->triangle]).distance_sq,
                      found->closest.distance_sq);
            (least > 0 ? apart : meet) += 1;
        }
    }
    std::cout << apart << " apart, " << meet << " meet, " << beyond << " beyond the limit\n";
    const std::size_t total = apart + meet + beyond;
    EXPECT_GT(apart, total / 10);
    EXPECT_GT(meet, total / 10);
    EXPECT_GT(beyond, total / 10);
}

/// A search that looked at all triangles in the box of a large triangle took 20 ms beside this
/// ball.
TEST(ModelTriangles, LargeTrianglesLookAtFewNodes) {
    Random random(20262);
    const Model ball(sphere_mesh(1, 142, 71));
    ASSERT_GT(ball.mesh().triangles.size(), 19000U);
    const ModelTriangles triangles(ball, Transform());
    for (const double size : {0.05, 0.5, 5.0, 500.0})
        for (const double height : {0.01, 1e-6, -0.01, -0.4}) {
            ModelTriangles::Work work;
            std::size_t listed = 0;
            constexpr std::size_t kTriangles = 100;
            for (std::size_t i = 0; i < kTriangles; ++i) {
                const Vec3 up = random.direction(), u = perpendicular(up), v = cross(up, u);
                const auto corner = [&](double angle) {
                    return (1 + height) * up + size * std::cos(angle) * u +
                           size * std::sin(angle) * v;
                };
                const double turn = random.uniform(0, 6);
                const Triangle t{corner(turn), corner(turn + 2), corner(turn + 4)};
                listed += triangles.nearest_to(t, 0.02, &work) ? 1 : 0;
            }
            std::cout << "size " << size << ", height " << height << ": "
                      << double(work.nodes) / kTriangles << " nodes, "
                      << double(work.triangles) / kTriangles << " triangles\n";
            // At the greatest depth, the smaller ones lie inside and far from all triangles.
            const bool is_deep = height < -0.1 && size < 1;
            EXPECT_EQ(listed, is_deep ? 0 : kTriangles);
            EXPECT_LT(work.nodes, 80 * kTriangles);
            EXPECT_LT(work.triangles, 250 * kTriangles);
        }
}

} // namespace
} // namespace abut::test
