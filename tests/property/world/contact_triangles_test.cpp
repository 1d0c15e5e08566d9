// The triangles that contact points name hold the points.

#include <abut/vector.h>
#include <abut/world.h>

#include "geometry/point_triangle_distance.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

namespace abut::test {
namespace {

/// A body whose triangles the test knows, or one that has none.
struct BodyWithTriangles {
    std::optional<Mesh> mesh;
    AnyShape shape;
};

BodyWithTriangles of_mesh(const Mesh& mesh) {
    return {mesh, Model(mesh)};
}

BodyWithTriangles any_body(Random& random, int kind) {
    const double r = random.uniform(0.2, 0.6);
    switch (kind) {
    case 0:
        return of_mesh(grid_mesh(6, 6, false, false, [&](double u, double v) {
            return Vec3{3 * u - 1.5, 3 * v - 1.5, 0.1 * std::cos(9 * u) * std::cos(8 * v)};
        }));
    case 1:
        return of_mesh(grid_mesh(6, 6, false, false, [&](double u, double v) {
            return Vec3{3 * u - 1.5, 3 * v - 1.5, 0};
        }));
    case 2:
        return of_mesh(box_mesh({-r, -r, -r}, {r, r, r}));
    case 3:
        return of_mesh(torus_mesh(0.6, 0.2, 12, 8));
    case 4:
        return of_mesh(sphere_mesh(r, 12, 8));
    case 5:
        return {{}, Box3{{-r, -r, -r}, {r, r, r}}};
    case 6:
        return {{}, Convex(prism_mesh(-r, r, r, 7))};
    case 7:
        return {{}, Sphere{{0, 0, 0}, r}};
    case 8:
        return {{}, Capsule{{{-r, 0, 0}, {r, 0, 0}}, 0.2}};
    case 9:
        return {{}, Cylinder{{{0, 0, -r}, {0, 0, r}}, 0.3}};
    default:
        return {{}, HalfSpace{{0, 0, 1}, 0}};
    }
}
constexpr int kBodyKinds = 11, kMeshKinds = 5, kCapsule = 8, kCylinder = 9;

double distance_from_triangle(const BodyWithTriangles& body, const Pose& pose,
                              std::uint32_t triangle, const Vec3& p) {
    const Transform world_from_body = pose;
    const auto& corners = body.mesh->triangles.at(triangle);
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k)
        t[k] = apply(world_from_body, body.mesh->positions[corners[k]]);
    return std::sqrt(nearest_on_triangle(p, t).distance_sq);
}

TEST(ContactTriangles, HoldThePoints) {
    Random random(3310);
    std::array<int, kBodyKinds> points{};
    for (int round = 0; round < many(3000); ++round) {
        const int kind_a = random.integer(0, kMeshKinds - 1),
                  kind_b = random.integer(0, kBodyKinds - 1);
        const bool swap = random.integer(0, 1) == 1;
        const BodyWithTriangles a = any_body(random, swap ? kind_b : kind_a),
                                b = any_body(random, swap ? kind_a : kind_b);
        Pose pose_a, pose_b;
        pose_b.translation = 0.9 * random.direction();
        if (random.integer(0, 1) == 1)
            pose_b.rotation = random.pose(0).rotation;
        World world;
        add(world, a.shape, pose_a), add(world, b.shape, pose_b);
        const double margin = random.integer(0, 1) * 0.05;
        for (const ContactManifold& m : world.contact_manifolds(margin))
            for (std::uint32_t i = 0; i < m.count; ++i) {
                const ContactPoint& p = m.points[i];
                ++points[static_cast<std::size_t>(kind_b)];
                const std::array bodies{&a, &b};
                const std::array at{p.point_a, p.point_b};
                const std::array triangles{p.triangle_a, p.triangle_b};
                for (std::size_t k = 0; k < 2; ++k) {
                    if (!bodies[k]->mesh) {
                        EXPECT_EQ(triangles[k], 0U);
                        continue;
                    }
                    const double away = distance_from_triangle(*bodies[k], k == 0 ? pose_a : pose_b,
                                                               triangles[k], at[k]);
                    // The ends of a capsule lie on planes, and a deep cylinder leaves across one.
                    EXPECT_LE(away, kind_b == kCapsule || kind_b == kCylinder ? 1 : 1e-9)
                        << "round " << round << " kinds " << kind_a << ' ' << kind_b << " swap "
                        << swap << " margin " << margin << " side " << k;
                }
            }
    }
    for (int kind = 0; kind < kBodyKinds; ++kind)
        EXPECT_GT(points[static_cast<std::size_t>(kind)], many(3000) / 50) << kind;
}

} // namespace
} // namespace abut::test
