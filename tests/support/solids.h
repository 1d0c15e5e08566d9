#pragma once

#include <abut/mesh.h>

#include "scenes/bodies.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

/// Non-convex solids, closed and oriented outward.
namespace abut::test {

/// A prism along z over a counter-clockwise polygon that is star-shaped about the origin.
inline Mesh star_prism(const std::vector<Vec3>& polygon, double height) {
    Mesh m;
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (const double z : {0.0, height})
        for (const Vec3& p : polygon)
            m.positions.push_back({p.x, p.y, z});
    m.positions.push_back({0, 0, 0});
    m.positions.push_back({0, 0, height});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, j, n + j});
        m.triangles.push_back({i, n + j, n + i});
        m.triangles.push_back({2 * n, j, i});
        m.triangles.push_back({2 * n + 1, n + i, n + j});
    }
    return m;
}

/// A gear with teeth between two radii.
inline Mesh gear_mesh(int teeth, double inner, double outer, double height) {
    std::vector<Vec3> polygon;
    for (int i = 0; i < 4 * teeth; ++i) {
        const double a = 2 * std::numbers::pi * i / (4 * teeth);
        const double r = i % 4 < 2 ? outer : inner;
        polygon.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    return star_prism(polygon, height);
}

/// The surface of some cells of a lattice, two triangles for each face. Vertices are shared.
/// Coordinates are small integers, so that many features are coplanar or collinear.
///
/// In          `solid(x, y, z)` for cells in [0, n). Where cells share only an edge, more than two
///             triangles use this edge, and the surface does not count as closed.
template <typename Solid>
Mesh cells_mesh(int n, const Solid& solid) {
    Mesh m;
    std::map<std::array<int, 3>, std::uint32_t> number;
    const auto vertex = [&](const std::array<int, 3>& p) {
        const auto [at, added] = number.try_emplace(p, static_cast<std::uint32_t>(number.size()));
        if (added)
            m.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
        return at->second;
    };
    const auto is_solid = [&](const std::array<int, 3>& c) {
        for (const int x : c)
            if (x < 0 || x >= n)
                return false;
        return bool(solid(c[0], c[1], c[2]));
    };
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    for (const int up : {0, 1}) {
                        std::array<int, 3> beyond{x, y, z};
                        beyond[axis] += 2 * up - 1;
                        if (!is_solid({x, y, z}) || is_solid(beyond))
                            continue;
                        std::array<int, 3> p{x, y, z}, q, r, s;
                        p[axis] += up;
                        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
                        q = p, ++q[u];
                        r = q, ++r[v];
                        s = p, ++s[v];
                        if (up == 0)
                            std::swap(q, s);
                        const std::uint32_t a = vertex(p), b = vertex(q), c = vertex(r),
                                            d = vertex(s);
                        m.triangles.push_back({a, b, c});
                        m.triangles.push_back({a, c, d});
                    }
    return m;
}

/// A cube of side 7 with a square pit in the middle of each edge and side. No convex piece of its
/// surface reaches its centre.
inline Mesh pitted_cube_mesh() {
    return cells_mesh(7, [](int x, int y, int z) {
        const int middle = (x == 3 ? 1 : 0) + (y == 3 ? 1 : 0) + (z == 3 ? 1 : 0);
        const bool deep = std::abs(x - 3) < 2 && std::abs(y - 3) < 2 && std::abs(z - 3) < 2;
        return deep || middle < 2;
    });
}

/// Random cells of a lattice. If no attempt gives a closed surface, cells in the shape of a U.
inline Mesh random_cells(Random& random, int n) {
    for (int attempt = 0; attempt < 40; ++attempt) {
        const auto side = static_cast<std::size_t>(n);
        std::vector<bool> solid(side * side * side);
        for (std::size_t i = 0; i < solid.size(); ++i)
            solid[i] = random.chance(0.55);
        Mesh m = cells_mesh(n, [&](int x, int y, int z) {
            return bool(
                solid[(static_cast<std::size_t>(x) * side + static_cast<std::size_t>(y)) * side +
                      static_cast<std::size_t>(z)]);
        });
        const MeshReport report = inspect(m);
        if (report.closed && report.flipped_edges == 0)
            return m;
    }
    return cells_mesh(3, [](int x, int /*y*/, int z) { return x != 1 || z == 0; });
}

/// A prism over a random star-shaped polygon.
inline Mesh random_star(Random& random) {
    std::vector<Vec3> polygon;
    const int n = random.integer(5, 12);
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n, r = random.uniform(0.5, 2);
        polygon.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    return star_prism(polygon, random.uniform(0.3, 1.5));
}

inline constexpr int kSolidKinds = 10;

/// A solid about 2 across, not always centred at the origin.
inline Mesh make_solid(Random& random, int kind) {
    const auto seed = static_cast<std::uint64_t>(random.integer(1, 1000));
    switch (kind % kSolidKinds) {
    case 0:
        return transformed(random_cells(random, 3), scaling(0.75, 0.75, 0.75));
    case 1:
        return random_star(random);
    case 2:
        return gear_mesh(random.integer(3, 8), 0.8, 1.2, 0.4);
    case 3:
        return scenes::boulder(128, seed);
    case 4:
        return torus_mesh(1, random.uniform(0.2, 0.6), random.integer(5, 14),
                          random.integer(4, 10));
    case 5: // a box with a cavity
        return joined(box_mesh({-1, -1, -1}, {1, 1, 1}),
                      reversed(box_mesh({-0.5, -0.5, -0.5}, {0.6, 0.7, 0.8})));
    case 6: // two solids that interpenetrate
        return joined(random_star(random), box_mesh({-0.4, -0.4, -0.4}, {0.4, 0.4, 2}));
    case 7: // faces that are planar only up to rounding
        return transformed(random_cells(random, 3), random.pose(0));
    case 8:
        return with_degenerates(random, gear_mesh(4, 0.5, 1, 0.7), 4);
    default:
        return transformed(random_cells(random, 2), scaling(1, 1, 0.5));
    }
}

/// The corners of a triangle of a mesh.
inline Triangle corners(const Mesh& mesh, std::uint32_t t) {
    const auto& v = mesh.triangles[t];
    return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

} // namespace abut::test
