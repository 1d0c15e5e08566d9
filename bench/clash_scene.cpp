#include "clash_scene.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut::bench {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double unit(scenes::Random& random) {
    return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

/// Uniform over all rotations.
/// Source      [Shoemake 1992].
std::array<double, 4> random_rotation(scenes::Random& random) {
    const double u = unit(random), v = kTurn * unit(random), w = kTurn * unit(random);
    const double p = std::sqrt(1 - u), q = std::sqrt(u);
    return {p * std::sin(v), p * std::cos(v), q * std::sin(w), q * std::cos(w)};
}

Vec3 placed(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

void extend(Box3& box, const Vec3& p) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                 std::min(box.lower.z, p.z)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                 std::max(box.upper.z, p.z)};
}

bool overlap(const Box3& a, const Box3& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

Box3 box_of(const Mesh& mesh, const Transform& placement) {
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, placed(placement, p));
    return box;
}

/// Moves the middle of the box to the origin and scales its diagonal to 1.
void normalise(Mesh& mesh) {
    const Box3 box = box_of(mesh, {});
    const Vec3 size{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                    box.upper.z - box.lower.z};
    const double scale = 1 / std::hypot(size.x, size.y, size.z);
    for (Vec3& p : mesh.positions)
        p = {scale * (p.x - box.lower.x - 0.5 * size.x), scale * (p.y - box.lower.y - 0.5 * size.y),
             scale * (p.z - box.lower.z - 0.5 * size.z)};
}

} // namespace

Mesh ribbed_ring(double tube_radius) {
    constexpr std::uint32_t kAround = 125, kAcross = 80;
    Mesh mesh;
    const double ring_radius = 0.5 - tube_radius;
    for (std::uint32_t i = 0; i < kAround; ++i)
        for (std::uint32_t j = 0; j < kAcross; ++j) {
            const double u = kTurn * i / kAround, v = kTurn * j / kAcross;
            // Nine ribs along the ring, and dents that wind around the tube.
            const double r =
                tube_radius * (1 + 0.2 * std::cos(9 * u) + 0.1 * std::sin(5 * v + 4 * u));
            const double reach = ring_radius + r * std::cos(v);
            mesh.positions.push_back({reach * std::cos(u), reach * std::sin(u), r * std::sin(v)});
            const std::uint32_t next_i = (i + 1) % kAround, next_j = (j + 1) % kAcross;
            const std::uint32_t a = i * kAcross + j, b = next_i * kAcross + j,
                                c = next_i * kAcross + next_j, d = i * kAcross + next_j;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

ClashScene make_clash_scene(const ClashSceneOptions& options) {
    return make_clash_scene(options, ribbed_ring(options.tube));
}

ClashScene make_clash_scene(const ClashSceneOptions& options, Mesh part) {
    normalise(part);
    ClashScene scene{std::move(part), {}, {}};
    scenes::Random random(options.seed);
    // The smallest cube of cells that holds all.
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
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
            if (overlap(boxes[a], boxes[b]))
                scene.candidates.emplace_back(a, b);
    return scene;
}

} // namespace abut::bench
