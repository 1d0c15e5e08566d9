#include "world/narrow_phase/offset_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace abut {

namespace {

const Model& unit_point() {
    static const Model model(Mesh{{{0, 0, 0}}, {{0, 0, 0}}});
    return model;
}

/// A segment along the diagonal, which a transform maps to the one axis with a length.
const Model& unit_segment() {
    static const Model model(Mesh{{{-1, -1, -1}, {1, 1, 1}}, {{0, 1, 1}}});
    return model;
}

constexpr std::uint32_t kSides = 32;

/// A ring of points around the third axis, whose edges touch the circle of radius 1.
void add_ring(Mesh& mesh, double z) {
    const double step = 2 * std::numbers::pi / kSides;
    const double radius = (1 + 0x1p-40) / std::cos(0.5 * step);
    for (std::uint32_t i = 0; i < kSides; ++i)
        mesh.positions.push_back({radius * std::cos(i * step), radius * std::sin(i * step), z});
}

/// A prism around the cylinder of radius 1 from -1 to 1.
const Model& unit_cylinder() {
    static const Model model = [] {
        Mesh mesh;
        add_ring(mesh, -1), add_ring(mesh, 1);
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t k = (i + 1) % kSides;
            mesh.triangles.push_back({i, k, kSides + k});
            mesh.triangles.push_back({i, kSides + k, kSides + i});
            if (i > 0 && k > 0) {
                mesh.triangles.push_back({0, k, i});
                mesh.triangles.push_back({kSides, kSides + i, kSides + k});
            }
        }
        return Model(std::move(mesh));
    }();
    return model;
}

/// A pyramid around the cone with its base at -1 and its apex at 1.
const Model& unit_cone() {
    static const Model model = [] {
        Mesh mesh;
        add_ring(mesh, -1);
        mesh.positions.push_back({0, 0, 1});
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t k = (i + 1) % kSides;
            mesh.triangles.push_back({i, k, kSides});
            if (i > 0 && k > 0)
                mesh.triangles.push_back({0, k, i});
        }
        return Model(std::move(mesh));
    }();
    return model;
}

/// Cuts each triangle of a mesh around the origin into four, with new corners at distance 1.
Mesh cut_in_four(const Mesh& mesh) {
    Mesh result;
    result.positions = mesh.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t k) {
        const auto [place, is_new] = middles.try_emplace(
            std::minmax(i, k), static_cast<std::uint32_t>(result.positions.size()));
        if (is_new)
            result.positions.push_back(normalized_or_zero(mesh.positions[i] + mesh.positions[k]));
        return place->second;
    };
    for (const auto& [i, j, k] : mesh.triangles) {
        const std::uint32_t ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
        for (const std::array<std::uint32_t, 3>& part :
             {std::array{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}})
            result.triangles.push_back(part);
    }
    return result;
}

/// A polyhedron around the ball of radius 1.
const Model& unit_ball() {
    static const Model model = [] {
        Mesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 2, 4},
                   {2, 1, 4},
                   {1, 3, 4},
                   {3, 0, 4},
                   {2, 0, 5},
                   {1, 2, 5},
                   {3, 1, 5},
                   {0, 3, 5}}};
        constexpr int kCuts = 4;
        for (int cut = 0; cut < kCuts; ++cut)
            mesh = cut_in_four(mesh);
        double inner = 1;
        for (const auto& [i, j, k] : mesh.triangles) {
            const Vec3 &p = mesh.positions[i], &q = mesh.positions[j], &r = mesh.positions[k];
            inner = std::min(inner, dot(normalized_or_zero(cross(q - p, r - p)), p));
        }
        for (Vec3& p : mesh.positions)
            p = ((1 + 0x1p-40) / inner) * p;
        return Model(std::move(mesh));
    }();
    return model;
}

/// The map from coordinates between -1 and 1 to those of a box.
Transform from_unit(const Vec3& centre, const std::array<Vec3, 3>& axis,
                    const std::array<double, 3>& half) {
    Transform result;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = half[k] * axis[k];
        result.m[3 * k] = side.x, result.m[3 * k + 1] = side.y, result.m[3 * k + 2] = side.z;
    }
    result.m[9] = centre.x, result.m[10] = centre.y, result.m[11] = centre.z;
    return result;
}

} // namespace

const Model& unit_cube() {
    static const Model model(Mesh{{{-1, -1, -1},
                                   {1, -1, -1},
                                   {-1, 1, -1},
                                   {1, 1, -1},
                                   {-1, -1, 1},
                                   {1, -1, 1},
                                   {-1, 1, 1},
                                   {1, 1, 1}},
                                  {{0, 2, 1},
                                   {1, 2, 3},
                                   {4, 5, 6},
                                   {5, 7, 6},
                                   {0, 1, 4},
                                   {1, 5, 4},
                                   {2, 6, 3},
                                   {3, 6, 7},
                                   {0, 4, 2},
                                   {2, 4, 6},
                                   {1, 3, 5},
                                   {3, 7, 5}}});
    return model;
}

OffsetSurface offset_surface_of(const RoundedBox& box) {
    const auto flat = std::count(box.half.begin(), box.half.end(), 0.0);
    const Model& surface = flat == 3 ? unit_point() : flat == 2 ? unit_segment() : unit_cube();
    return {surface, from_unit(box.centre, box.axis, box.half), box.radius};
}

OffsetSurface offset_surface_of(const CurvedShape& curved) {
    const SupportShape& solid = curved.solid;
    const Model& surface = solid.kind == CoreKind::cylinder ? unit_cylinder()
                           : solid.kind == CoreKind::cone   ? unit_cone()
                                                            : unit_ball();
    return {surface, from_unit(solid.centre, solid.axis, solid.half), 0};
}

OffsetSurface offset_surface_of(const BodyShape& shape) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return offset_surface_of(*box);
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return {convex->surface, {}, 0};
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return offset_surface_of(*curved);
    assert(std::holds_alternative<Model>(shape));
    return {std::get<Model>(shape), {}, 0};
}

} // namespace abut
