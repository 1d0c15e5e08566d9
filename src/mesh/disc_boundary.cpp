#include "mesh/disc_boundary.h"

#include <algorithm>
#include <cstddef>

namespace abut {

namespace {

/// From one vertex to another; in the order of where they begin.
using Side = std::uint64_t;

Side side(std::uint32_t from, std::uint32_t to) {
    return Side{from} << 32 | to;
}
std::uint32_t from(Side side) {
    return static_cast<std::uint32_t>(side >> 32);
}
std::uint32_t to(Side side) {
    return static_cast<std::uint32_t>(side);
}

} // namespace

std::vector<std::uint32_t> disc_boundary(std::span<const IndexTriangle> triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (const IndexTriangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            sides.push_back(side(t[k], t[(k + 1) % 3]));
    std::sort(sides.begin(), sides.end());
    if (std::adjacent_find(sides.begin(), sides.end()) != sides.end())
        return {}; // two triangles on one side of an edge

    std::size_t vertices = 0;
    std::vector<Side> border; // sides without the opposite one
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (from(sides[i]) == to(sides[i]))
            return {};
        if (i == 0 || from(sides[i]) != from(sides[i - 1]))
            ++vertices;
        if (!std::binary_search(sides.begin(), sides.end(), side(to(sides[i]), from(sides[i]))))
            border.push_back(sides[i]);
    }
    // Vertices - edges + triangles: 1 for a disc. Other surfaces with one boundary have less, unless
    // they fall apart, or have closed ones hanging at a vertex: those have no projection that
    // shows all of one side.
    const std::size_t edges = (sides.size() + border.size()) / 2;
    if (vertices + triangles.size() != edges + 1 || border.empty())
        return {};

    std::vector<std::uint32_t> loop;
    std::uint32_t at = from(border.front());
    do {
        const auto next = std::lower_bound(border.begin(), border.end(), side(at, 0));
        const bool leaves_once = next != border.end() && from(*next) == at &&
                                 (next + 1 == border.end() || from(*(next + 1)) != at);
        if (!leaves_once || loop.size() == border.size())
            return {};
        loop.push_back(at);
        at = to(*next);
    } while (at != loop.front());
    return loop.size() == border.size() ? loop : std::vector<std::uint32_t>{};
}

} // namespace abut
