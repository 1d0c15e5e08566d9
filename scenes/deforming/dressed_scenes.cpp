#include "scenes/deforming/cloth_scenes.h"
#include "scenes/deforming/figure.h"
#include "scenes/deforming/frame.h"
#include "scenes/deforming/surfaces.h"
#include "scenes/random.h"

#include <algorithm>
#include <utility>

namespace abut::scenes {

namespace {

/// A cone that hangs from a ring around the torso.
struct Skirt {
    double waist = Figure::kWaist; ///< height of the ring
    double length = 0;             ///< along the cloth
    double flare = 0;              ///< angle between cloth and vertical at rest, in turns
};

/// Ratio of the size of the figure's triangles to that of the skirts'.
constexpr double kFigureSize = 1.6;
constexpr double kWaistRadius = Figure::kTorsoRadius + 0.012;

Mesh cone(const Skirt& skirt, double size) {
    const Point2 slope = on_circle(skirt.flare);
    return turned_surface(
        straight_profile({0, kWaistRadius},
                         {skirt.length * slope.u, kWaistRadius + skirt.length * slope.v}, size),
        size);
}

/// A figure in skirts. Its pose at a time is stance(seconds).
ClothModel dressed(std::uint64_t triangles, const std::vector<Skirt>& skirts, Random& random,
                   std::function<Stance(double)> stance) {
    const auto mesh_of = [&](double size) {
        Mesh mesh = Figure(kFigureSize * size).mesh();
        for (const Skirt& skirt : skirts)
            append(mesh, cone(skirt, size), turned({0, -1, 0}, kZ, {0, skirt.waist, 0}));
        return mesh;
    };
    const double size = size_for(triangles, mesh_of);
    const Figure figure(kFigureSize * size);
    ClothModel model;
    model.mesh = mesh_of(size);
    figure.place(stance(0), model.mesh.positions);
    const std::size_t body = figure.mesh().positions.size();
    std::vector<Vec3> at_rest = model.mesh.positions;
    for (std::size_t v = 0; v < at_rest.size(); ++v)
        model.driven.push_back(v < body || std::ranges::any_of(skirts, [&](const Skirt& skirt) {
                                   return at_rest[v].y == skirt.waist;
                               }));
    ruffle(std::span(model.mesh.positions).subspan(body), size, random);
    model.settings.thickness = std::min(0.3 * size, 0.004);
    model.settings.hangs = true;
    model.drive = [=, stance = std::move(stance)](double seconds, std::span<Vec3> positions) {
        const Stance now = stance(seconds);
        figure.place(now, positions);
        for (std::size_t v = body; v < positions.size(); ++v)
            positions[v] = apply(now.world_from_figure, at_rest[v]);
    };
    return model;
}

/// The sine of an angle in turns.
double wave(double turns) {
    return on_circle(turns).v;
}

} // namespace

ClothModel dancer(const DeformingOptions& options) {
    std::vector<Skirt> skirts(7);
    for (std::size_t layer = 0; layer < skirts.size(); ++layer) {
        const auto higher = static_cast<double>(layer);
        skirts[layer] = {Figure::kWaist + 0.012 * higher, 0.52 - 0.03 * higher, 0.17};
    }
    Random random(options.seed);
    const double phase = random.uniform(0, 1);
    return dressed(options.triangles, skirts, random, [phase](double t) {
        const double wakes = smooth_step(t);
        const double step = wakes * wave(0.8 * t);
        Stance stance;
        stance.left = {0.10 * step, 0.05 * wakes * (1 - wave(0.8 * t + 0.25)),
                       0.21 + 0.05 * wakes * wave(0.5 * t + phase), 0.08 * wakes * wave(0.7 * t),
                       0.06};
        stance.right = {-0.10 * step, 0.05 * wakes * (1 + wave(0.8 * t + 0.25)),
                        0.21 + 0.05 * wakes * wave(0.6 * t - phase), -0.08 * wakes * wave(0.7 * t),
                        0.06};
        const double turn = 0.35 * wakes * wave(0.3 * t + 0.02 * phase);
        stance.world_from_figure =
            after(at({0.15 * wakes * wave(0.4 * t), 0.04 * wakes * wave(1.6 * t), 0}),
                  turned_about_y(turn));
        return stance;
    });
}

ClothModel skirt(const DeformingOptions& options) {
    Random random(options.seed);
    const double way = random.chance(0.5) ? 1 : -1;
    return dressed(options.triangles, {{Figure::kWaist, 0.72, 0.16}}, random, [way](double t) {
        const double wakes = smooth_step(t);
        const double step = wakes * wave(0.7 * t);
        Stance stance;
        stance.left = {0.09 * step, 0.04 * wakes * (1 - wave(0.7 * t + 0.25)), 0.2, -0.06 * step,
                       0.05};
        stance.right = {-0.09 * step, 0.04 * wakes * (1 + wave(0.7 * t + 0.25)), 0.2, 0.06 * step,
                        0.05};
        // The figure makes half a turn one way, then back: the cloth swings on and winds around the
        // legs.
        const double turn = way * 0.5 * wakes * wave(0.22 * t);
        stance.world_from_figure =
            after(at({0, 0.02 * wakes * wave(1.4 * t), 0.2 * wakes * wave(0.15 * t)}),
                  turned_about_y(turn));
        return stance;
    });
}

} // namespace abut::scenes
