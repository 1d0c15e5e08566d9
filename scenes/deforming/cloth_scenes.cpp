#include "scenes/deforming/cloth_scenes.h"

#include "scenes/bodies.h"
#include "scenes/deforming/figure.h"
#include "scenes/deforming/frame.h"
#include "scenes/deforming/surfaces.h"
#include "scenes/random.h"

#include <algorithm>
#include <cmath>

namespace abut::scenes {

namespace {

/// The largest thickness at which cloth with triangles of this size does not push against itself.
double thickness_of(double size) {
    return std::min(0.3 * size, 0.006);
}

void move_to(std::span<Vec3> positions, const Mesh& mesh, const Transform& world_from_mesh) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        positions[v] = apply(world_from_mesh, mesh.positions[v]);
}

} // namespace

ClothModel cloth_on_ball(const DeformingOptions& options) {
    constexpr double kRadius = 0.5, kSide = 2.2, kDrop = 0.1;
    const auto ball_of = [](double size) {
        // The ball's triangles are twice as coarse as the cloth, whose squares have the area
        // size^2.
        const double area = 4 * std::numbers::pi * kRadius * kRadius;
        Mesh ball = sphere(static_cast<std::uint32_t>(2 * area / (4 * size * size)));
        for (Vec3& p : ball.positions)
            p = scaled(p, kRadius);
        return ball;
    };
    const double size = size_for(options.triangles, [&](double s) {
        Mesh mesh = ball_of(s);
        append(mesh, sheet(kSide, kSide, s));
        return mesh;
    });
    Random random(options.seed);
    const Mesh ball = ball_of(size);
    ClothModel model;
    model.mesh = ball;
    const double turn = random.uniform(0, 1), x = random.uniform(-0.05, 0.05),
                 z = random.uniform(-0.05, 0.05);
    const std::uint32_t cloth = append(model.mesh, sheet(kSide, kSide, size),
                                       after(at({x, kRadius + kDrop, z}), turned_about_y(turn)));
    ruffle(std::span(model.mesh.positions).subspan(cloth), size, random);
    model.driven.assign(model.mesh.positions.size(), false);
    std::fill_n(model.driven.begin(), cloth, true);
    model.settings.thickness = thickness_of(size);
    model.settings.friction = 0.6;
    model.drive = [ball](double seconds, std::span<Vec3> positions) {
        // The ball turns slowly, back and forth on the way, once the cloth has come down.
        const double t = std::max(0.0, seconds - 1.5);
        const double turns = smooth_step(t) * (0.25 * t + 0.1 * on_circle(0.8 * t).v);
        move_to(positions, ball, turned_about_y(turns));
    };
    return model;
}

ClothModel twisted_tube(const DeformingOptions& options) {
    constexpr double kRadius = 0.3, kLength = 1.6;
    const auto tube_of = [](double size) {
        return turned_surface(
            straight_profile({-kLength / 2, kRadius}, {kLength / 2, kRadius}, size), size);
    };
    const double size = size_for(options.triangles, tube_of);
    Random random(options.seed);
    ClothModel model;
    const Mesh tube = tube_of(size);
    model.mesh = tube;
    ruffle(model.mesh.positions, size, random);
    for (const Vec3& p : tube.positions)
        model.driven.push_back(std::abs(p.x) > kLength / 2 - 2 * size);
    model.settings.thickness = thickness_of(size);
    model.settings.gravity = {};
    model.settings.drag = 2;
    model.drive = [tube](double seconds, std::span<Vec3> positions) {
        constexpr double kTurnsPerSecond = 0.25, kMostTurns = 1.5, kNearer = 0.35, kUntil = 6;
        const double turns = std::min(kMostTurns, kTurnsPerSecond * seconds);
        const double nearer = kNearer * smooth_step(seconds / kUntil);
        for (std::size_t v = 0; v < positions.size(); ++v) {
            const double side = tube.positions[v].x < 0 ? -1 : 1;
            positions[v] = apply(after(at({-side * nearer, 0, 0}), turned_about_x(side * turns)),
                                 tube.positions[v]);
        }
    };
    return model;
}

} // namespace abut::scenes
