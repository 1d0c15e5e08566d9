#include "surfaces.h"

#include <numbers>

namespace drop {

namespace {

/// Makes a ball whose halves are moved apart along z.
abut::Mesh stretched_ball(double radius, double half_length) {
    constexpr std::uint32_t kRound = 12, kRows = 8; // points around, and rows with the poles
    abut::Mesh mesh;
    for (std::uint32_t row = 0; row <= kRows; ++row)
        for (std::uint32_t i = 0; i < kRound; ++i) {
            const double polar = std::numbers::pi * row / kRows,
                         turn = 2 * std::numbers::pi * i / kRound;
            const double r = radius * std::sin(polar), z = radius * std::cos(polar);
            mesh.positions.push_back({r * std::cos(turn), r * std::sin(turn),
                                      z + (2 * row < kRows ? 1 : -1) * half_length});
        }
    for (std::uint32_t row = 0; row < kRows; ++row)
        for (std::uint32_t i = 0; i < kRound; ++i) {
            const std::uint32_t a = row * kRound + i, b = row * kRound + (i + 1) % kRound;
            mesh.triangles.push_back({a, a + kRound, b + kRound});
            mesh.triangles.push_back({a, b + kRound, b});
        }
    return mesh;
}

} // namespace

abut::Mesh surface_of(const abut::Sphere& sphere) {
    return stretched_ball(sphere.radius, 0);
}

abut::Mesh surface_of(const abut::Capsule& capsule) {
    return stretched_ball(capsule.radius, 0.5 * length(capsule.axis.b - capsule.axis.a));
}

abut::Mesh surface_of(const abut::Box3& box) {
    abut::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.push_back({(corner & 1) != 0 ? box.upper.x : box.lower.x,
                                  (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                  (corner & 4) != 0 ? box.upper.z : box.lower.z});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

abut::Mesh Surfaces::placed(Simulator& simulator) const {
    abut::Mesh all;
    for (std::size_t i = 0; i < of_body.size(); ++i) {
        const Transform& t = simulator.world().world_from_body(simulator.bodies()[i].id);
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const Vec3& p : of_body[i].positions)
            all.positions.push_back(origin(t) + turned(t, p));
        for (const auto& [a, b, c] : of_body[i].triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

} // namespace drop
