#include "mesh/disc_boundary.h"

#include <algorithm>
#include <cstddef>

namespace abut {

namespace {

/// A directed edge of the border.
struct Side {
    std::uint32_t from, to;
};

bool operator<(const Side& side, std::uint32_t from) {
    return side.from < from;
}

/// Number of distinct values. Sorts them.
std::size_t count_distinct(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    return static_cast<std::size_t>(std::unique(numbers.begin(), numbers.end()) - numbers.begin());
}

/// The border's vertices in order, if it is a single loop that visits no vertex twice; otherwise
/// empty.
std::vector<std::uint32_t> loop_of(std::vector<Side>& border) {
    std::sort(border.begin(), border.end(),
              [](const Side& a, const Side& b) { return a.from < b.from; });
    std::vector<std::uint32_t> loop;
    std::uint32_t at = border.front().from;
    do {
        const auto next = std::lower_bound(border.begin(), border.end(), at);
        const bool leaves_once = next != border.end() && next->from == at &&
                                 (next + 1 == border.end() || (next + 1)->from != at);
        if (!leaves_once || loop.size() == border.size())
            return {};
        loop.push_back(at);
        at = next->to;
    } while (at != loop.front());
    return loop.size() == border.size() ? loop : std::vector<std::uint32_t>{};
}

} // namespace

std::vector<std::uint32_t> disc_boundary(const SurfaceView& surface,
                                         std::span<const std::uint32_t> triangles) {
    // Uses of edges by triangles. The lowest bit tells whether the use starts at the higher vertex.
    std::vector<std::uint32_t> uses, vertices;
    uses.reserve(3 * triangles.size());
    vertices.reserve(3 * triangles.size());
    for (const std::uint32_t triangle : triangles) {
        const IndexTriangle& v = surface.triangles[triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t edge = surface.features.edges_of[triangle][k];
            if (edge == kNoEdge)
                return {};
            uses.push_back(edge << 1 | (v[k] > v[(k + 1) % 3] ? 1U : 0U));
            vertices.push_back(v[k]);
        }
    }
    std::sort(uses.begin(), uses.end());
    if (std::adjacent_find(uses.begin(), uses.end()) != uses.end())
        return {}; // two triangles use the edge in the same direction

    std::vector<Side> border; // edges with only one use
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (i + 1 < uses.size() && uses[i] >> 1 == uses[i + 1] >> 1) {
            ++i;
            continue;
        }
        const auto& [low, high] = surface.features.edges[uses[i] >> 1];
        border.push_back((uses[i] & 1U) != 0 ? Side{high, low} : Side{low, high});
    }
    // The Euler characteristic, vertices - edges + triangles, is 1 for a disc. It is less for other
    // connected surfaces with one boundary. Only surfaces that are not connected, or have closed
    // surfaces attached at a vertex, can reach 1 as well. They have no projection that shows one
    // side of all triangles.
    const std::size_t edges = (uses.size() + border.size()) / 2;
    if (border.empty() || count_distinct(vertices) + triangles.size() != edges + 1)
        return {};
    return loop_of(border);
}

} // namespace abut
