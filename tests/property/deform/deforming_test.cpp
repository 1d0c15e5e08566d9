/// The deforming scenes: sizes, repeatability, and whether they move as their materials would.
#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/mesh.h>
#include <abut/progress.h>

#include "scenes/bodies.h"
#include "scenes/deforming/deforming.h"
#include "scenes/deforming/frame.h"
#include "scenes/rigid_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <string>
#include <vector>

namespace abut {
namespace {

using scenes::add;
using scenes::norm;
using scenes::scaled;
using scenes::subtract;

constexpr std::uint64_t kSmall = 1200;

void play(DeformingScene& scene, int frames) {
    for (int i = 0; i < frames; ++i)
        scene.step();
}

/// FNV-1a hash of a mesh.
std::uint64_t hash_of(const Mesh& mesh) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&](std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte)
            hash = (hash ^ (value >> (8 * byte) & 255)) * 0x100000001b3U;
    };
    for (const Vec3& p : mesh.positions)
        for (const double v : {p.x, p.y, p.z})
            mix(std::bit_cast<std::uint64_t>(v));
    for (const auto& t : mesh.triangles)
        std::ranges::for_each(t, mix);
    return hash;
}

/// Volume enclosed by the triangles from `first` on.
double volume(const Mesh& mesh, std::size_t first) {
    double six_fold = 0;
    for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        six_fold += dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c]));
    }
    return six_fold / 6;
}

TEST(DeformingScenes, HitTheirNumberOfTriangles) {
    for (const DeformingSceneInfo& info : kDeformingScenes)
        for (const std::uint64_t target : {1000U, 1700U, 4000U, 0U}) {
            if (info.name == "fracture")
                continue; // its target is the number at the end: see below
            const auto scene = make_deforming_scene(info.name, {.triangles = target});
            const double ratio = static_cast<double>(scene->mesh().triangles.size()) /
                                 static_cast<double>(target == 0 ? info.triangles : target);
            EXPECT_NEAR(ratio, 1, 0.05) << info.name << ", " << target;
        }
}

TEST(DeformingScenes, AreTheSameForTheSameOptions) {
    for (const DeformingSceneInfo& info : kDeformingScenes) {
        const auto hash_after = [&](std::uint64_t seed, int threads) {
            set_threads(threads);
            const auto scene = make_deforming_scene(info.name, {kSmall, seed});
            play(*scene, 30);
            set_threads(0);
            return hash_of(scene->mesh());
        };
        const std::uint64_t hash = hash_after(1, 1);
        EXPECT_EQ(hash_after(1, 2), hash) << info.name;
        EXPECT_NE(hash_after(2, 2), hash) << info.name;
    }
}

TEST(DeformingScenes, AreValidInEveryFrame) {
    for (const DeformingSceneInfo& info : kDeformingScenes) {
        const auto scene = make_deforming_scene(info.name, {.triangles = kSmall});
        for (int frame = 0; frame < 60; ++frame) {
            const MeshReport report = inspect(scene->mesh()); // throws if a coordinate is not
                                                              // finite
            EXPECT_EQ(report.degenerate_triangles, 0U) << info.name << ", frame " << frame;
            EXPECT_EQ(report.flipped_edges, 0U) << info.name << ", frame " << frame;
            for (const Vec3& p : scene->mesh().positions)
                for (const double v : {p.x, p.y, p.z}) {
                    const auto as_float = static_cast<float>(v);
                    ASSERT_EQ(as_float, v) << info.name;
                }
            scene->step();
        }
    }
}

/// Without impacts the scenes would not be useful input for collision detection.
TEST(DeformingScenes, HoldImpacts) {
    for (const DeformingSceneInfo& info : kDeformingScenes) {
        const auto scene = make_deforming_scene(info.name, {.triangles = kSmall});
        play(*scene, info.name == "twist" ? 110 : 10);
        int with_impacts = 0;
        for (int frame = 0; frame < 30; ++frame) {
            const Mesh before = scene->mesh();
            scene->step();
            if (before.triangles != scene->mesh().triangles)
                continue;
            Deformable surface(before);
            surface.advance(scene->mesh().positions);
            with_impacts += is_free_of_self_impacts(surface) ? 0 : 1;
        }
        EXPECT_GT(with_impacts, 0) << info.name;
    }
}

TEST(DeformingScenes, ClothKeepsItsLengths) {
    for (const std::string name : {"cloth-ball", "dancer", "skirt", "twist"}) {
        const auto scene = make_deforming_scene(name, {.triangles = kSmall});
        const Deformable surface(scene->mesh());
        const auto lengths = [&] {
            std::vector<double> result;
            for (const auto& [a, b] : surface.edges())
                result.push_back(
                    norm(subtract(scene->mesh().positions[a], scene->mesh().positions[b])));
            return result;
        };
        const std::vector<double> at_rest = lengths();
        play(*scene, 75);
        std::vector<double> stretch = lengths();
        std::ranges::transform(stretch, at_rest, stretch.begin(), std::divides());
        std::ranges::sort(stretch);
        const auto count = static_cast<double>(stretch.size());
        EXPECT_NEAR(std::accumulate(stretch.begin(), stretch.end(), 0.0) / count, 1, 0.05) << name;
        EXPECT_LT(stretch[static_cast<std::size_t>(0.99 * count)], 1.25) << name;
        EXPECT_GT(stretch[static_cast<std::size_t>(0.01 * count)], 0.6) << name;
    }
}

TEST(DeformingScenes, ClothStaysOutsideTheBall) {
    const auto scene = make_deforming_scene("cloth-ball", {.triangles = kSmall});
    play(*scene, 90);
    // The ball's vertices come first and stay at its radius.
    const auto& positions = scene->mesh().positions;
    const auto cloth = std::ranges::find_if(
        positions, [](const Vec3& p) { return std::abs(norm(p) - 0.5) > 1e-6; });
    ASSERT_LT(cloth, positions.end());
    std::size_t touching = 0;
    for (auto p = cloth; p != positions.end(); ++p) {
        EXPECT_GT(norm(*p), 0.46); // faces of the ball lie a little inside it
        touching += norm(*p) < 0.55 ? 1 : 0;
    }
    EXPECT_GT(touching, 50U) << "the cloth lies on the ball";
}

TEST(DeformingScenes, BallsStayInTheirBox) {
    const auto scene = make_deforming_scene("balls", {.triangles = kSmall});
    std::vector<Vec3> before = scene->mesh().positions;
    for (int frame = 0; frame < 150; ++frame) {
        scene->step();
        const std::vector<Vec3>& positions = scene->mesh().positions;
        // The box's corners come first, x fastest; its centre is the origin.
        std::array<Vec3, 3> axes;
        for (std::size_t axis = 0; axis < 3; ++axis)
            axes[axis] = scaled(subtract(positions[std::size_t{1} << axis], positions[0]), 0.5);
        for (std::size_t v = 8; v < positions.size(); ++v) {
            for (const Vec3& axis : axes)
                ASSERT_LT(std::abs(dot(positions[v], axis)), 1.08) << "frame " << frame;
            ASSERT_LT(norm(subtract(positions[v], before[v])), 0.3) << "frame " << frame;
        }
        before = positions;
    }
}

TEST(DeformingScenes, ABrokenBallIsInPieces) {
    for (const std::uint64_t target : {1000U, 3000U}) {
        const auto scene = make_deforming_scene("fracture", {.triangles = target});
        constexpr std::size_t kFloorTriangles = 12;
        const double volume_before = volume(scene->mesh(), kFloorTriangles);
        EXPECT_EQ(inspect(scene->mesh()).components, 2U);
        int changes = 0;
        std::size_t triangles = scene->mesh().triangles.size();
        for (int frame = 0; frame < 110; ++frame) {
            scene->step();
            const MeshReport report = inspect(scene->mesh());
            EXPECT_EQ(report.boundary_edges, 0U);
            EXPECT_GE(report.triangles, triangles);
            changes += report.triangles > triangles ? 1 : 0;
            triangles = report.triangles;
        }
        EXPECT_GE(changes, 2);
        EXPECT_GE(inspect(scene->mesh()).components, target / 250 + 1);
        EXPECT_NEAR(volume(scene->mesh(), kFloorTriangles) / volume_before, 1, 0.1);
        EXPECT_NEAR(static_cast<double>(triangles) / static_cast<double>(target), 1, 0.05);
    }
}

TEST(DeformingScenes, RefuseBadOptions) {
    const auto code_of = [](const std::string& name, std::uint64_t triangles) {
        try {
            make_deforming_scene(name, {.triangles = triangles});
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::interrupted;
    };
    EXPECT_EQ(code_of("castle", 2000), ErrorCode::bad_argument);
    EXPECT_EQ(code_of("twist", 999), ErrorCode::bad_argument);
    EXPECT_EQ(code_of("twist", 10'000'001), ErrorCode::bad_argument);
}

scenes::RigidBody ball_at(const Vec3& centre, const Vec3& velocity, double mass) {
    scenes::RigidBody body;
    body.shape = scenes::sphere(200);
    body.pose.translation = centre;
    body.velocity = velocity;
    body.inverse_mass = 1 / mass;
    body.inverse_inertia = 1 / (0.4 * mass);
    return body;
}

TEST(RigidBodies, ABounceKeepsMomentumAndMakesNoEnergy) {
    scenes::RigidBodies bodies(
        {ball_at({-1.5, 0, 0}, {4, 0.5, 0}, 1), ball_at({1.5, 0.3, 0}, {-2, 0, 1}, 3)},
        {.gravity = {}, .thickness = 0.01, .restitution = 0.8});
    const auto momentum = [&] {
        Vec3 sum;
        for (const scenes::RigidBody& body : bodies.bodies())
            sum = add(sum, scaled(body.velocity, 1 / body.inverse_mass));
        return sum;
    };
    const auto energy = [&] {
        double sum = 0;
        for (const scenes::RigidBody& body : bodies.bodies())
            sum += dot(body.velocity, body.velocity) / body.inverse_mass +
                   dot(body.spin, body.spin) / body.inverse_inertia;
        return sum / 2;
    };
    const Vec3 momentum_before = momentum();
    const double energy_before = energy();
    for (int frame = 0; frame < 60; ++frame)
        bodies.step();
    EXPECT_LT(norm(subtract(momentum(), momentum_before)), 1e-12);
    EXPECT_LT(energy(), energy_before);
    EXPECT_GT(energy(), 0.3 * energy_before);
    EXPECT_LT(bodies.bodies()[0].velocity.x, bodies.bodies()[1].velocity.x) << "they have bounced";
}

} // namespace
} // namespace abut
