#pragma once

#include <abut/shapes.h>

#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

/// Meshes of boxes on a lattice, and the unit cells that they fill.
namespace abut::test {

inline constexpr int kCells = 5;

/// Cells of a lattice that a solid fills.
struct Cells {
    std::array<bool, kCells * kCells * kCells> filled{};

    static std::size_t index(int x, int y, int z) {
        return static_cast<std::size_t>((x * kCells + y) * kCells + z);
    }
    [[nodiscard]] bool at(int x, int y, int z) const {
        const bool outside = std::min({x, y, z}) < 0 || std::max({x, y, z}) >= kCells;
        return !outside && filled[index(x, y, z)];
    }
    void set(const Vec3& lower, const Vec3& upper, bool value) {
        for (int x = int(lower.x); x < int(upper.x); ++x)
            for (int y = int(lower.y); y < int(upper.y); ++y)
                for (int z = int(lower.z); z < int(upper.z); ++z)
                    filled[index(x, y, z)] = value;
    }
    [[nodiscard]] int count() const { return int(std::count(filled.begin(), filled.end(), true)); }
    /// Where a point lies to the closed cells.
    [[nodiscard]] Side side(const Vec3& p) const {
        int in = 0, out = 0;
        for (int i = 0; i < 8; ++i) {
            const auto cell = [&](double v, int bit) {
                const double low = std::floor(v);
                return int(low) - (v == low && (i >> bit & 1) != 0 ? 1 : 0);
            };
            ++(at(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2)) ? in : out);
        }
        return in == 0 ? Side::outside : out == 0 ? Side::inside : Side::on_surface;
    }
    /// The distance of a point from the squares between filled and empty cells.
    [[nodiscard]] double distance(const Vec3& p) const {
        double least = HUGE_VAL;
        const std::array<double, 3> at_p{p.x, p.y, p.z};
        for (int x = -1; x < kCells; ++x)
            for (int y = -1; y < kCells; ++y)
                for (int z = -1; z < kCells; ++z)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        std::array<int, 3> c{x, y, z}, next = c;
                        ++next.at(axis);
                        if (at(c[0], c[1], c[2]) == at(next[0], next[1], next[2]))
                            continue;
                        double sum = 0;
                        for (std::size_t k = 0; k < 3; ++k) {
                            const double low = k == axis ? next.at(k) : c.at(k),
                                         high = k == axis ? low : low + 1;
                            const double off = std::max({low - at_p.at(k), at_p.at(k) - high, 0.0});
                            sum += off * off;
                        }
                        least = std::min(least, std::sqrt(sum));
                    }
        return least;
    }
};

/// A box whose faces are cut along random diagonals.
inline Mesh random_box_mesh(Random& random, const Vec3& lower, const Vec3& upper) {
    Mesh m = box_mesh(lower, upper);
    for (std::size_t i = 0; i < m.triangles.size(); i += 2)
        if (random.chance(0.5)) {
            // (a, b, c), (a, c, d) become (a, b, d), (b, c, d).
            const auto [a, b, c] = m.triangles[i];
            const std::uint32_t d = m.triangles[i + 1][2];
            m.triangles[i] = {a, b, d}, m.triangles[i + 1] = {b, c, d};
        }
    return m;
}

/// Each triangle as four, so that vertices lie in the middle of edges.
inline Mesh subdivided(const Mesh& m) {
    Mesh fine;
    for (const auto& t : m.triangles) {
        const Vec3 &a = m.positions[t[0]], &b = m.positions[t[1]], &c = m.positions[t[2]];
        const auto n = static_cast<std::uint32_t>(fine.positions.size());
        for (const Vec3& p : {a, b, c, 0.5 * a + 0.5 * b, 0.5 * b + 0.5 * c, 0.5 * c + 0.5 * a})
            fine.positions.push_back(p);
        for (const auto& [i, j, k] : {std::array{0U, 3U, 5U}, std::array{3U, 1U, 4U},
                                      std::array{5U, 4U, 2U}, std::array{3U, 4U, 5U}})
            fine.triangles.push_back({n + i, n + j, n + k});
    }
    return fine;
}

struct Shells {
    Mesh mesh;
    Cells cells;
};

/// Boxes that may overlap, share faces or edges, or lie in each other.
inline Shells random_shells(Random& random, int count) {
    Shells s;
    for (int i = 0; i < count; ++i) {
        Vec3 lower = random.on_lattice(kCells - 1), upper = random.on_lattice(kCells - 1);
        if (i > 0 && random.chance(0.3)) // flush with the last one
            lower = s.mesh.positions[s.mesh.positions.size() - 8];
        const Vec3 low = min(lower, upper), high = max(lower, upper) + Vec3{1, 1, 1};
        const Vec3 top = min(high, Vec3{kCells, kCells, kCells});
        s.mesh = joined(s.mesh, random.chance(0.5) ? box_mesh(low, top)
                                                   : random_box_mesh(random, low, top));
        s.cells.set(low, top, true);
    }
    return s;
}

} // namespace abut::test
