#include "view/levels/closed_surfaces.h"

#include "core/disjoint_sets.h"
#include "math/vector.h"

#include <algorithm>
#include <tuple>

namespace abut {

namespace {

using Corner = std::array<std::uint32_t, 4>; ///< part and position

/// The corners of triangles as numbers of different positions of parts.
struct NumberedCorners {
    explicit NumberedCorners(const std::vector<std::array<ChunkVertex, 3>>& triangles) {
        std::vector<std::pair<Corner, std::uint32_t>> corners;
        for (const auto& triangle : triangles)
            for (const ChunkVertex& v : triangle)
                corners.push_back({{v.part, v.position[0], v.position[1], v.position[2]},
                                   static_cast<std::uint32_t>(corners.size())});
        std::sort(corners.begin(), corners.end());
        of.resize(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            count += i > 0 && corners[i].first != corners[i - 1].first ? 1 : 0;
            of[corners[i].second] = count;
        }
        count += corners.empty() ? 0 : 1;
    }
    std::vector<std::uint32_t> of; ///< three for each triangle
    std::uint32_t count = 0;
};

Vec3 point_of(const ChunkVertex& v) {
    return {double(v.position[0]), double(v.position[1]), double(v.position[2])};
}

/// For each surface, by the least number of its corners: whether it is closed.
std::vector<bool> closed_surfaces(const std::vector<std::array<ChunkVertex, 3>>& triangles,
                                  const NumberedCorners& corners,
                                  const std::vector<std::uint32_t>& surface) {
    struct Edge {
        std::uint32_t from = 0, to = 0;
        int direction = 0;
    };
    std::vector<Edge> edges;
    std::vector<double> volume(corners.count, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        volume[surface[corners.of[3 * t]]] += dot(point_of(a), cross(point_of(b), point_of(c)));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = corners.of[3 * t + k], to = corners.of[3 * t + (k + 1) % 3];
            if (from != to)
                edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    std::vector<bool> is_closed(corners.count);
    for (std::size_t i = 0; i < is_closed.size(); ++i)
        is_closed[i] = volume[i] > 0;
    for (std::size_t i = 0; i < edges.size();) {
        const Edge& edge = edges[i];
        int sum = 0;
        for (; i < edges.size() && edges[i].from == edge.from && edges[i].to == edge.to; ++i)
            sum += edges[i].direction;
        if (sum != 0)
            is_closed[surface[edge.from]] = false;
    }
    return is_closed;
}

} // namespace

std::uint32_t put_closed_first(std::vector<std::array<ChunkVertex, 3>>& triangles) {
    const NumberedCorners corners(triangles);
    DisjointSets sets(corners.count);
    for (std::size_t i = 0; i + 2 < corners.of.size(); i += 3) {
        sets.unite(corners.of[i], corners.of[i + 1]);
        sets.unite(corners.of[i], corners.of[i + 2]);
    }
    const std::vector<std::uint32_t> surface = std::move(sets).roots();
    const std::vector<bool> is_closed = closed_surfaces(triangles, corners, surface);
    std::vector<std::array<ChunkVertex, 3>> sorted;
    sorted.reserve(triangles.size());
    for (const bool closed : {true, false})
        for (std::size_t t = 0; t < triangles.size(); ++t)
            if (is_closed[surface[corners.of[3 * t]]] == closed)
                sorted.push_back(triangles[t]);
    std::uint32_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        count += is_closed[surface[corners.of[3 * t]]] ? 1 : 0;
    triangles = std::move(sorted);
    return count;
}

} // namespace abut
