#pragma once

#include <abut/mesh.h>

#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

/// Solids that are not convex. Closed, outward.
namespace abut::test {

/// A prism along z of a polygon that is star-shaped about the origin, counter-clockwise.
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

/// A gear's outline: teeth between two radii.
inline Mesh gear_mesh(int teeth, double inner, double outer, double height) {
    std::vector<Vec3> polygon;
    for (int i = 0; i < 4 * teeth; ++i) {
        const double a = 2 * std::numbers::pi * i / (4 * teeth);
        const double r = i % 4 < 2 ? outer : inner;
        polygon.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    return star_prism(polygon, height);
}

/// The surface of some cells of a lattice, each face as two triangles; vertices are shared, but
/// coordinates are small integers, so that most of what can be coplanar or collinear is.
///
/// In          `solid(x, y, z)` of cells in [0, n). Where cells meet in an edge only, the surface is
///             not closed in the sense that each edge has two triangles.
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

/// A cube of side 7 with a square pit in the middle of each edge and side, so that no convex piece
/// of its surface reaches the middle.
inline Mesh pitted_cube_mesh() {
    return cells_mesh(7, [](int x, int y, int z) {
        const int middle = (x == 3 ? 1 : 0) + (y == 3 ? 1 : 0) + (z == 3 ? 1 : 0);
        const bool deep = std::abs(x - 3) < 2 && std::abs(y - 3) < 2 && std::abs(z - 3) < 2;
        return deep || middle < 2;
    });
}

} // namespace abut::test
