#include "mesh/equal_positions.h"
#include "mesh/topology.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <tuple>

namespace abut::test {
namespace {

struct FloatPosition {
    float x, y, z;
};

TEST(FirstEqualPositions, NegativeZeroIsZeroAndNaNIsItself) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const std::vector<FloatPosition> positions{{0, 1, 2}, {-0.0F, 1, 2},    {kNaN, 0, 0},
                                               {0, 2, 1}, {kNaN, -0.0F, 0}, {0, 1, 2}};
    EXPECT_EQ(first_equal_positions(std::span(positions)),
              (std::vector<std::uint32_t>{0, 0, 2, 3, 2, 0}));
    EXPECT_TRUE(first_equal_positions(std::span<const Vec3>()).empty());
}

/// Triangles of lattice points, with unshared and shared vertices. Some have no area.
Mesh lattice_soup(Random& random, int side) {
    Mesh m;
    for (int i = 0; i < 400; ++i)
        m.positions.push_back(random.on_lattice(side) - Vec3{1, 1, 1});
    for (int i = 0; i < 300; ++i) {
        auto& t = m.triangles.emplace_back();
        for (std::uint32_t& v : t)
            v = static_cast<std::uint32_t>(random.integer(0, 399));
    }
    return m;
}

TEST(Topology, EqualsABruteForceSearch) {
    Random random(1);
    std::size_t merged = 0, shared = 0, apart = 0;
    for (const int side : {2, 5, 9}) {
        const Mesh m = lattice_soup(random, side);
        const Topology t = make_topology(m);
        for (std::uint32_t v = 0; v < m.positions.size(); ++v) {
            const auto first = std::find(m.positions.begin(), m.positions.end(), m.positions[v]);
            ASSERT_EQ(t.vertex_of[v], static_cast<std::uint32_t>(first - m.positions.begin()));
            merged += t.vertex_of[v] != v ? 1 : 0;
        }

        using Row = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t,
                               std::uint32_t, std::uint32_t>;
        std::vector<Row> expected, found;
        for (std::uint32_t i = 0; i < m.triangles.size(); ++i) {
            std::array<std::uint32_t, 3> w{};
            for (std::size_t k = 0; k < 3; ++k)
                w.at(k) = t.vertex_of[m.triangles[i].at(k)];
            if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0])
                continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = w.at(k), to = w.at((k + 1) % 3);
                expected.emplace_back(std::min(from, to), std::max(from, to), i, from, to,
                                      m.triangles[i].at((k + 2) % 3));
            }
        }
        std::sort(expected.begin(), expected.end());
        for (const HalfEdge& e : t.half_edges)
            found.emplace_back(e.lower(), e.upper(), e.triangle, e.from, e.to, e.apex);
        ASSERT_EQ(found, expected);
        for (const HalfEdge& e : t.half_edges)
            shared += t.edge(e.to, e.from).size() > 1 ? 1 : 0;

        const std::vector<std::uint32_t> component = vertex_components(m, t);
        // Spreads labels along triangles until nothing changes.
        std::vector<std::uint32_t> label = t.vertex_of;
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& triangle : m.triangles)
                for (const std::uint32_t v : triangle)
                    for (const std::uint32_t w : triangle)
                        if (label[t.vertex_of[v]] < label[t.vertex_of[w]])
                            label[t.vertex_of[w]] = label[t.vertex_of[v]], changed = true;
        }
        for (std::uint32_t v = 0; v < label.size(); ++v)
            for (std::uint32_t w = 0; w < v; ++w) {
                const bool connected = label[t.vertex_of[v]] == label[t.vertex_of[w]];
                ASSERT_EQ(component[v] == component[w], connected);
                apart += connected ? 0 : 1;
            }
    }
    EXPECT_GT(merged, 300U);
    EXPECT_GT(shared, 100U);
    EXPECT_GT(apart, 100U);
}

} // namespace
} // namespace abut::test
