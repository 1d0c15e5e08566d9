#include "articulated/shape_meshes.h"

#include "math/vector.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kCylinderSides = 64;
constexpr int kSphereSubdivisions = 3;
/// The polyhedra are enlarged by this share, so that rounding leaves the shape inside.
constexpr double kRoundingShare = 1e-12;

using Corners = std::array<std::uint32_t, 3>;

Mesh icosahedron() {
    const double g = std::numbers::phi;
    Mesh mesh;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g}) {
            mesh.positions.push_back({0, s, t});
            mesh.positions.push_back({s, t, 0});
            mesh.positions.push_back({t, 0, s});
        }
    // Three vertices make a face if all their distances are 2, the length of an edge.
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return length_sq(mesh.positions[a] - mesh.positions[b]) < 4.5;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c)
                if (near(a, b) && near(b, c) && near(a, c)) {
                    const auto& p = mesh.positions;
                    const bool outward = dot(cross(p[b] - p[a], p[c] - p[a]), p[a]) > 0;
                    mesh.triangles.push_back(outward ? Corners{a, b, c} : Corners{a, c, b});
                }
    return mesh;
}

/// Cuts each triangle into four. New vertices are shared.
Mesh subdivided(const Mesh& mesh) {
    Mesh result{mesh.positions, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(result.positions.size()));
        if (is_new)
            result.positions.push_back(
                normalized_or_zero(0.5 * (result.positions[a] + result.positions[b])));
        return place->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        for (const Corners& corners :
             {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
            result.triangles.push_back(corners);
    }
    return result;
}

/// The least distance of a triangle's plane from the origin.
double least_plane_distance(const Mesh& mesh) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& p = mesh.positions;
        const Vec3 normal = normalized_or_zero(cross(p[b] - p[a], p[c] - p[a]));
        least = std::min(least, dot(normal, p[a]));
    }
    return least;
}

} // namespace

Mesh box_mesh(const Vec3& size) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y,
                                  (i & 4 ? 0.5 : -0.5) * size.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

EnclosingMesh cylinder_mesh(double radius, double length) {
    const double outer =
        radius / std::cos(std::numbers::pi / kCylinderSides) * (1 + kRoundingShare);
    Mesh mesh;
    for (std::uint32_t i = 0; i < kCylinderSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCylinderSides;
        for (const double z : {-0.5 * length, 0.5 * length})
            mesh.positions.push_back({outer * std::cos(angle), outer * std::sin(angle), z});
    }
    for (std::uint32_t i = 0; i < kCylinderSides; ++i) {
        const std::uint32_t low = 2 * i;
        const std::uint32_t next = 2 * ((i + 1) % kCylinderSides);
        mesh.triangles.push_back({low, next, next + 1});
        mesh.triangles.push_back({low, next + 1, low + 1});
        if (i > 0 && i + 1 < kCylinderSides) { // fans from the first vertex close both ends
            mesh.triangles.push_back({0, next, low});
            mesh.triangles.push_back({1, low + 1, next + 1});
        }
    }
    return {std::move(mesh), outer - radius};
}

EnclosingMesh sphere_mesh(double radius) {
    Mesh mesh = icosahedron();
    for (Vec3& p : mesh.positions)
        p = normalized_or_zero(p);
    for (int i = 0; i < kSphereSubdivisions; ++i)
        mesh = subdivided(mesh);
    const double outer = radius / least_plane_distance(mesh) * (1 + kRoundingShare);
    for (Vec3& p : mesh.positions)
        p = outer * p;
    return {std::move(mesh), outer - radius};
}

void scale_mesh(Mesh& mesh, const Vec3& scale) {
    for (Vec3& p : mesh.positions)
        p = {scale.x * p.x, scale.y * p.y, scale.z * p.z};
    if (scale.x * scale.y * scale.z < 0)
        for (auto& [a, b, c] : mesh.triangles)
            std::swap(b, c);
}

} // namespace abut
