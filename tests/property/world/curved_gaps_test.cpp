// Cylinders, cones and ellipsoids near meshes with edges, borders and bumps: of their contacts within a margin,
// the deepest is as deep as the bodies are apart, and all points lie on both surfaces.

#include <abut/vector.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <vector>

namespace abut::test {
namespace {

Mesh hilly(int cells, double height, double waves) {
    return grid_mesh(cells, cells, false, false, [=](double u, double v) {
        const double x = 4 * u - 2, y = 4 * v - 2;
        return Vec3{x, y, height * std::sin(3 * waves * x) * std::cos(2 * waves * y)};
    });
}

TEST(CurvedGaps, TheDeepestPointIsAsDeepAsTheBodiesAreApart) {
    Random random(20261701);
    constexpr std::size_t kFirstHill = 3;
    const std::vector<Model> meshes{Model(box_mesh({-1, -1, -1}, {1, 1, 1})),
                                    Model(sphere_mesh(1, 24, 16)),
                                    Model(open_box_mesh({-1, -1, -1}, {1, 1, 1})),
                                    Model(hilly(20, 0.15, 1)), Model(hilly(7, 0.3, 13))};
    int apart = 0, deep = 0;
    for (int round = 0; round < many(250); ++round) {
        SCOPED_TRACE(round);
        const auto k =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(meshes.size()) - 1));
        const double r = random.uniform(0.1, 0.5), l = random.uniform(0.1, 0.6);
        const std::vector<AnyShape> shapes{Cylinder{{{0, 0, -l}, {0, 0, l}}, r},
                                           Cone{{0, 0, l}, {0, 0, -l}, r},
                                           Ellipsoid{{}, {r, l, 0.5 * (r + l)}}};
        const AnyShape& shape = shapes.at(std::size_t(random.integer(0, 2)));
        // It comes from outside until it is as near as this; a little later it is inside.
        const double wanted = random.uniform(-0.01, 0.03);
        Vec3 from = 3 * random.direction(), to{};
        if (k >= kFirstHill)
            from = {random.uniform(-1, 1), random.uniform(-1, 1), 3}, to = {from.x, from.y, -1};
        Pose pose = random.pose(0);
        World world;
        world.add(meshes[k], {});
        const BodyId id = add(world, shape, pose);
        double near = 0, far = 1;
        for (int i = 0; i < 14; ++i) {
            const double share = 0.5 * (near + far);
            pose.translation = from + share * (to - from);
            world.move(id, pose);
            const auto gaps = world.within(4);
            (gaps.empty() || gaps[0].distance > std::max(wanted, 1e-6) ? near : far) = share;
        }
        pose.translation = from + near * (to - from);
        if (wanted < 0)
            pose.translation = pose.translation - wanted / length(to - from) * (to - from);
        world.move(id, pose);
        constexpr double kMargin = 0.05;
        const auto gaps = world.within(kMargin);
        if (gaps.empty())
            continue;
        double deepest = -HUGE_VAL;
        for (const ContactManifold& m : world.contact_manifolds(kMargin))
            for (std::uint32_t i = 0; i < m.count; ++i) {
                const ContactPoint& p = m.points.at(i);
                deepest = std::max(deepest, p.depth);
                EXPECT_LE(length(p.point_a - p.point_b - p.depth * m.normal), 1e-9);
                EXPECT_LE(distance_from_surface(meshes[k], {}, p.point_a), 1e-6);
                EXPECT_LE(std::abs(distance_from_surface(shape, pose, p.point_b)), 1e-6);
            }
        if (gaps[0].distance > 1e-9) {
            ++apart;
            EXPECT_NEAR(deepest, -gaps[0].distance, 1e-10);
        } else {
            ++deep;
            EXPECT_GE(deepest, 0);
            EXPECT_LE(deepest, 2.5 * std::abs(wanted));
        }
        if (HasFailure())
            return;
    }
    std::cout << apart << " apart, " << deep << " inside\n";
    EXPECT_GT(apart, 90);
    EXPECT_GT(deep, 25);
}

} // namespace
} // namespace abut::test
