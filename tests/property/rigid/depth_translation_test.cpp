// Depths of clashes, penetration and signed distance do not depend on where the models are.

#include <abut/clash.h>
#include <abut/penetration.h>
#include <abut/scene.h>

#include "scenes/bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr double kGrid = 0x1p-12;

Vec3 on_grid(const Vec3& p) {
    const auto round = [](double v) { return std::round(v / kGrid) * kGrid; };
    return {round(p.x), round(p.y), round(p.z)};
}
Mesh on_grid(Mesh mesh) {
    for (Vec3& p : mesh.positions)
        p = on_grid(p);
    return mesh;
}
Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions)
        p = p + by;
    return mesh;
}

Mesh any_mesh(int kind) {
    switch (kind) {
    case 0:
        return scenes::boulder(300, 7);
    case 1:
        return scenes::knot(400);
    case 2:
        return torus_mesh(1, 0.35, 16, 9);
    case 3:
        return box_mesh({-1, -0.25, -0.125}, {1, 0.25, 0.125});
    case 4:
        return sphere_mesh(0.7, 12, 8);
    default: // open
        return grid_mesh(9, 9, false, false, [](double u, double v) {
            return Vec3{2 * u - 1, 2 * v - 1, 0.2 * std::sin(9 * u) * std::cos(5 * v)};
        });
    }
}

/// Depths of two meshes under one transform, as each query reports them.
struct Depths {
    double clash = 0;
    Depth penetration;
    Gap gap;
    ClashKind kind{};
};

Depths depths_of(const Mesh& a, const Mesh& b, const Transform& world, double touch = 0) {
    Scene scene;
    scene.meshes = {a, b};
    scene.parts.resize(2);
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene.parts[i].id = std::to_string(i);
        scene.parts[i].mesh = i;
        scene.parts[i].world_from_mesh = world;
    }
    Depths result;
    const ClashReport report = find_clashes({scene}, {.touch_tolerance = touch});
    if (!report.clashes.empty()) {
        result.clash = -report.clashes[0].distance;
        result.kind = report.clashes[0].kind;
    }
    const Model model_a(a), model_b(b);
    result.penetration = penetration(model_a, world, model_b, world, {.separation = false});
    result.gap = distance(model_a, world, model_b, world, {.signed_distance = true});
    return result;
}

TEST(DepthTranslation, DepthsAreInvariantUnderTranslation) {
    Random random(5401);
    int deep = 0, in_mesh = 0, known = 0, close = 0;
    for (int round = 0; round < many(300); ++round) {
        const bool symmetric = random.chance(0.5); // equal depths at many places
        const Vec3 off = symmetric
                             ? Vec3{0.25 * random.integer(-3, 3), 0.25 * random.integer(-3, 3),
                                    0.125 * random.integer(-3, 3)}
                             : random.in_cube(0.8);
        const Mesh a = on_grid(any_mesh(random.integer(0, 5))),
                   b = moved(on_grid(any_mesh(random.integer(0, 5))), on_grid(off));
        const Vec3 by = on_grid(std::ldexp(1, random.integer(0, 20)) * random.in_cube(1));
        const bool bake = random.chance(0.5);
        const Depths here = depths_of(a, b, {});
        if (here.clash <= 0)
            continue;
        ++deep;
        in_mesh += bake ? 1 : 0;
        const Depths there = bake ? depths_of(moved(a, by), moved(b, by), {})
                                  : depths_of(a, b, translation(by.x, by.y, by.z));
        ASSERT_NEAR(there.clash, here.clash, 1e-9 * here.clash) << round;
        ASSERT_NEAR(there.penetration.depth, here.penetration.depth, 1e-9 * here.clash) << round;
        ASSERT_NEAR(there.penetration.depth_at_most, here.penetration.depth_at_most,
                    1e-9 * here.clash)
            << round;
        ASSERT_NEAR(there.gap.distance, here.gap.distance, 1e-9 * here.clash) << round;
        ASSERT_EQ(there.kind, here.kind);
        // All three depths follow one definition: each is attained, so it is below the upper bounds
        // of the others.
        const double at_most = here.penetration.depth_at_most * (1 + 1e-12);
        ASSERT_LE(here.clash, at_most) << round;
        ASSERT_LE(-here.gap.distance, at_most) << round;
        ASSERT_LE(here.penetration.depth, -here.gap.at_least * (1 + 1e-12)) << round;
        if (here.kind == ClashKind::hard &&
            here.penetration.depth_at_most < 1.1 * here.penetration.depth) {
            ++known;
            // The clash job takes fewer samples, so it may find less.
            close += here.clash >= 0.9 * here.penetration.depth ? 1 : 0;
        }
    }
    std::cout << deep << " deep, " << in_mesh << " of them moved by their positions, " << close
              << " of " << known << " clashes close to the penetration\n";
    EXPECT_GT(deep, many(300) / 2);
    EXPECT_GT(in_mesh, deep / 4);
    EXPECT_GT(close, known * 9 / 10);
}

/// Splits each quadrangle of a box along its other diagonal.
Mesh turned_diagonals(Mesh box) {
    for (std::size_t i = 0; i + 1 < box.triangles.size(); i += 2) {
        auto &s = box.triangles[i], &t = box.triangles[i + 1];
        // Triangles p q r and p r s of a face become q r s and q s p.
        for (std::size_t turn = 0; turn < 3; ++turn)
            for (std::size_t other = 0; other < 3; ++other)
                if (s[turn] == t[other] && s[(turn + 2) % 3] == t[(other + 1) % 3]) {
                    const std::uint32_t p = s[turn], q = s[(turn + 1) % 3], r = s[(turn + 2) % 3],
                                        w = t[(other + 2) % 3];
                    s = {q, r, w}, t = {q, w, p};
                    turn = other = 3;
                }
    }
    return box;
}

TEST(DepthTranslation, EveryQueryGivesCoincidentSolidsTheSameDepth) {
    const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1}), other = turned_diagonals(box);
    ASSERT_NE(box.triangles, other.triangles);
    double last = 0;
    for (const double at : {0.0, 1.0, 4096.0, 1048576.0}) {
        const Depths d = depths_of(box, other, translation(at, -at, 2 * at));
        EXPECT_EQ(d.kind, ClashKind::hard);
        EXPECT_EQ(depths_of(box, other, translation(at, -at, 2 * at), 0.01).kind,
                  ClashKind::duplicate);
        EXPECT_NEAR(d.clash, 1, 1e-6);
        EXPECT_EQ(d.penetration.depth, d.clash);
        EXPECT_TRUE(d.penetration.interpenetrate);
        EXPECT_EQ(d.gap.distance, -d.clash);
        if (last > 0) {
            EXPECT_NEAR(d.clash, last, 1e-9);
        }
        last = d.clash;
        const Model a(box), b(other);
        const Vec3 out = penetration(a, {}, b, {}).separation;
        EXPECT_NEAR(length(out), 1, 0.01);
    }
}

} // namespace
} // namespace abut::test
