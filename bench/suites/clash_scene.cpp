#include "suites/clash_scene.h"

#include "placement.h"
#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut::bench {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

bool overlap(const Box3& a, const Box3& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// Cubes around the parts' centres that hold the part in any rotation.
std::vector<Box3> rotation_boxes(const ClashScene& scene) {
    double radius = 0;
    for (const Vec3& p : scene.part.positions)
        radius = std::max(radius, std::hypot(p.x, p.y, p.z));
    std::vector<Box3> boxes;
    for (const Transform& t : scene.placements)
        boxes.push_back({{t.m[9] - radius, t.m[10] - radius, t.m[11] - radius},
                         {t.m[9] + radius, t.m[10] + radius, t.m[11] + radius}});
    return boxes;
}

} // namespace

Mesh flanged_elbow(double bend, double tube_radius) {
    constexpr std::uint32_t kRings = 125, kAcross = 80;
    Mesh mesh;
    const auto on_ring = [&](double along, double radius, double v) {
        const double u = bend * (along - 0.5), reach = 1 + radius * std::cos(v);
        return Vec3{reach * std::cos(u), reach * std::sin(u), radius * std::sin(v)};
    };
    for (std::uint32_t i = 0; i < kRings; ++i)
        for (std::uint32_t j = 0; j < kAcross; ++j) {
            const double along = static_cast<double>(i) / (kRings - 1), v = kTurn * j / kAcross;
            const double flange = std::min(along, 1 - along) < 0.06 ? 1.6 : 1;
            // Seven ribs along the bend, and dents that wind around it.
            const double bumps =
                1 + 0.12 * std::cos(7 * kTurn * along) + 0.06 * std::sin(5 * v + 2 * kTurn * along);
            mesh.positions.push_back(on_ring(along, tube_radius * flange * bumps, v));
        }
    const auto first_cap = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(on_ring(0, 0, 0));
    mesh.positions.push_back(on_ring(1, 0, 0));
    for (std::uint32_t j = 0; j < kAcross; ++j) {
        const std::uint32_t next = (j + 1) % kAcross, last = (kRings - 1) * kAcross;
        for (std::uint32_t ring = 0; ring < last; ring += kAcross) {
            const std::uint32_t a = ring + j, b = a + kAcross, c = ring + kAcross + next,
                                d = ring + next;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
        mesh.triangles.push_back({first_cap, j, next});
        mesh.triangles.push_back({first_cap + 1, last + next, last + j});
    }
    return mesh;
}

ClashScene make_clash_scene(const ClashSceneOptions& options) {
    return make_clash_scene(options, flanged_elbow(options.bend, options.tube));
}

ClashScene make_clash_scene(const ClashSceneOptions& options, Mesh part) {
    normalise(part);
    ClashScene scene{std::move(part), {}, {}};
    scenes::Random random(options.seed);
    // The smallest cube of cells that holds all instances.
    std::size_t side = 1;
    while (side * side * side < options.instances)
        ++side;
    std::vector<Box3> boxes;
    for (std::size_t i = 0; i < options.instances; ++i) {
        const auto jittered = [&](std::size_t cell) {
            return options.spacing * (static_cast<double>(cell) + 0.6 * (unit(random) - 0.5));
        };
        Pose pose;
        pose.rotation = random_rotation(random);
        pose.translation.x = jittered(i % side);
        pose.translation.y = jittered(i / side % side);
        pose.translation.z = jittered(i / side / side);
        scene.placements.emplace_back(pose);
        boxes.push_back(box_of(scene.part, scene.placements.back()));
    }
    if (options.boxes == CandidateBoxes::any_rotation)
        boxes = rotation_boxes(scene);
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
            if (overlap(boxes[a], boxes[b]))
                scene.candidates.emplace_back(a, b);
    return scene;
}

} // namespace abut::bench
