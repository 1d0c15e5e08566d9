#pragma once

#include <abut/mesh.h>

#include "math/transform.h"
#include "tests/support/random.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

/// Meshes for tests. Closed ones are oriented outward.
namespace abut::test {

inline Mesh box_mesh(const Vec3& lower, const Vec3& upper) {
    Mesh m;
    for (unsigned i = 0; i < 8; ++i)
        m.positions.push_back(
            {i & 1U ? upper.x : lower.x, i & 2U ? upper.y : lower.y, i & 4U ? upper.z : lower.z});
    m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}
/// A box without its top, z = upper.
inline Mesh open_box_mesh(const Vec3& lower, const Vec3& upper) {
    Mesh m = box_mesh(lower, upper);
    m.triangles.erase(m.triangles.begin() + 2, m.triangles.begin() + 4);
    return m;
}

/// A grid of quads over u and v, closed in the directions that `wrap_u` and `wrap_v` select.
inline Mesh grid_mesh(int nu, int nv, bool wrap_u, bool wrap_v, auto&& point) {
    Mesh m;
    const int pu = wrap_u ? nu : nu + 1, pv = wrap_v ? nv : nv + 1;
    for (int i = 0; i < pu; ++i)
        for (int j = 0; j < pv; ++j)
            m.positions.push_back(point(double(i) / nu, double(j) / nv));
    const auto index = [&](int i, int j) {
        return static_cast<std::uint32_t>(i % pu * pv + j % pv);
    };
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            const std::uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1),
                                d = index(i, j + 1);
            m.triangles.push_back({a, b, c});
            m.triangles.push_back({a, c, d});
        }
    return m;
}

inline Mesh torus_mesh(double major, double minor, int nu, int nv) {
    return grid_mesh(nu, nv, true, true, [&](double u, double v) {
        const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
        const double r = major + minor * std::cos(b);
        return Vec3{r * std::cos(a), r * std::sin(a), minor * std::sin(b)};
    });
}

/// A sphere whose poles are single vertices.
inline Mesh sphere_mesh(double radius, int nu, int nv) {
    Mesh m;
    m.positions.push_back({0, 0, -radius});
    for (int j = 1; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            const double a = 2 * std::numbers::pi * i / nu,
                         b = std::numbers::pi * (double(j) / nv - 0.5);
            m.positions.push_back({radius * std::cos(b) * std::cos(a),
                                   radius * std::cos(b) * std::sin(a), radius * std::sin(b)});
        }
    m.positions.push_back({0, 0, radius});
    const auto top = static_cast<std::uint32_t>(m.positions.size() - 1);
    const auto index = [&](int i, int j) {
        return static_cast<std::uint32_t>(1 + (j - 1) * nu + i % nu);
    };
    for (int i = 0; i < nu; ++i) {
        m.triangles.push_back({0, index(i + 1, 1), index(i, 1)});
        m.triangles.push_back({top, index(i, nv - 1), index(i + 1, nv - 1)});
        for (int j = 1; j + 1 < nv; ++j) {
            m.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            m.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    }
    return m;
}

/// A closed regular prism about the x axis from `start` to `end`. Its cross-section depends only on
/// radius and sides.
inline Mesh prism_mesh(double start, double end, double radius, int sides) {
    Mesh m;
    const auto n = static_cast<std::uint32_t>(sides);
    for (const double x : {start, end})
        for (int i = 0; i < sides; ++i) {
            const double a = 2 * std::numbers::pi * i / sides;
            m.positions.push_back({x, radius * std::cos(a), radius * std::sin(a)});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, j, n + j});
        m.triangles.push_back({i, n + j, n + i});
        if (i >= 2) {
            m.triangles.push_back({0, i, i - 1});
            m.triangles.push_back({n, n + i - 1, n + i});
        }
    }
    return m;
}

/// A closed ring about the x axis, with an inner wall, an outer wall and two annular ends. The
/// inner wall is that of prism_mesh(start, end, inner, sides), inside out.
inline Mesh ring_mesh(double start, double end, double inner, double outer, int sides) {
    Mesh m;
    const auto n = static_cast<std::uint32_t>(sides);
    for (const double x : {start, end})
        for (const double radius : {inner, outer})
            for (int i = 0; i < sides; ++i) {
                const double a = 2 * std::numbers::pi * i / sides;
                m.positions.push_back({x, radius * std::cos(a), radius * std::sin(a)});
            }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        m.triangles.push_back({a, b, c});
        m.triangles.push_back({a, c, d});
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        quad(n + i, n + j, 3 * n + j, 3 * n + i); // outer wall
        quad(j, i, 2 * n + i, 2 * n + j);         // inner wall
        quad(i, j, n + j, n + i);                 // start
        quad(2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j);
    }
    return m;
}

inline Mesh transformed(Mesh m, const Transform& t) {
    for (Vec3& p : m.positions)
        p = apply(t, p);
    return m;
}
inline Mesh reversed(Mesh m) {
    for (auto& t : m.triangles)
        std::swap(t[1], t[2]);
    return m;
}
inline Mesh joined(Mesh a, const Mesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& t : b.triangles)
        a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return a;
}
/// Unrelated triangles, each about as large as `size`.
inline Mesh soup_mesh(Random& random, int count, double half, double size) {
    Mesh m;
    for (int i = 0; i < count; ++i) {
        const Vec3 middle = random.in_cube(half);
        const auto first = static_cast<std::uint32_t>(m.positions.size());
        for (int k = 0; k < 3; ++k)
            m.positions.push_back(middle + random.in_cube(size));
        m.triangles.push_back({first, first + 1, first + 2});
    }
    return m;
}
/// Adds triangles that degenerate to segments and points.
inline Mesh with_degenerates(Random& random, Mesh m, int count) {
    const auto n = static_cast<int>(m.positions.size());
    for (int i = 0; i < count; ++i) {
        const auto a = static_cast<std::uint32_t>(random.integer(0, n - 1)),
                   b = static_cast<std::uint32_t>(random.integer(0, n - 1));
        m.triangles.push_back(i % 2 == 0 ? std::array{a, b, a} : std::array{a, a, a});
    }
    return m;
}

inline Transform translation(double x, double y, double z) {
    return Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z});
}
inline Transform scaling(double x, double y, double z) {
    return Transform({x, 0, 0, 0, y, 0, 0, 0, z, 0, 0, 0});
}

} // namespace abut::test
