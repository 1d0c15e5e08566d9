#include "convex/polytope.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// The side from -> to of a triangle whose third corner is `apex`: after the edge to `to`, the ring
/// around `from` goes on with the one to `apex`.
struct Corner {
    std::uint32_t from, to, apex;
};

std::vector<Corner> corners_by_vertex(std::span<const IndexTriangle> triangles) {
    std::vector<Corner> corners;
    corners.reserve(3 * triangles.size());
    for (const IndexTriangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            corners.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
    std::sort(corners.begin(), corners.end(), [](const Corner& c, const Corner& d) {
        return c.from != d.from ? c.from < d.from : c.to < d.to;
    });
    return corners;
}

/// Puts the corners around one vertex, sorted by `to`, into the order in which they follow.
void order_ring(std::span<Corner> ring) {
    const std::vector<Corner> sorted(ring.begin(), ring.end());
    for (std::size_t i = 1; i < ring.size(); ++i)
        ring[i] =
            *std::lower_bound(sorted.begin(), sorted.end(), ring[i - 1].apex,
                              [](const Corner& c, std::uint32_t vertex) { return c.to < vertex; });
}

void set_twins(Polytope& polytope) {
    struct Ends {
        std::uint32_t low, high, edge;
    };
    std::vector<Ends> ends;
    for (std::uint32_t v = 0; v < polytope.vertices.size(); ++v) {
        const HullVertex& vertex = polytope.vertices[v];
        for (std::uint32_t e = vertex.first_edge; e < vertex.first_edge + vertex.degree; ++e) {
            const std::uint32_t w = polytope.edges[e].target;
            ends.push_back({std::min(v, w), std::max(v, w), e});
        }
    }
    std::sort(ends.begin(), ends.end(), [](const Ends& a, const Ends& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        polytope.edges[ends[i].edge].twin = ends[i + 1].edge;
        polytope.edges[ends[i + 1].edge].twin = ends[i].edge;
    }
}

} // namespace

Polytope make_polytope(std::span<const Vec3> points, std::span<const IndexTriangle> triangles) {
    std::vector<Corner> corners = corners_by_vertex(triangles);
    if (triangles.empty() && points.size() == 2)
        corners = {{0, 1, 1}, {1, 0, 0}};
    Polytope polytope;
    polytope.edges.reserve(corners.size());
    auto ring = corners.begin();
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        const auto end =
            std::find_if(ring, corners.end(), [v](const Corner& c) { return c.from != v; });
        order_ring({ring, end});
        const auto first = static_cast<std::uint32_t>(polytope.edges.size());
        for (; ring != end; ++ring)
            polytope.edges.push_back({points[ring->to], ring->to, 0});
        polytope.vertices.push_back(
            {points[v], first, static_cast<std::uint32_t>(polytope.edges.size()) - first});
    }
    set_twins(polytope);
    return polytope;
}

std::uint32_t climb(const Polytope& polytope, const Vec3& direction, std::uint32_t start) {
    // Most vertices have no more neighbours than this. To look at so many always, the next vertices'
    // neighbours among them, costs less than a branch on their number.
    constexpr std::uint32_t kRun = 8;
    const auto edges = static_cast<std::uint32_t>(polytope.edges.size());
    std::uint32_t best = start;
    double height = dot(direction, polytope.vertices[start].at);
    for (;;) {
        const HullVertex& vertex = polytope.vertices[best];
        const std::uint32_t at = best;
        const auto look = [&](const HullEdge& edge) {
            if (const double h = dot(direction, edge.to); h > height)
                height = h, best = edge.target;
        };
        const HullEdge* const first = polytope.edges.data() + vertex.first_edge;
        if (vertex.degree <= kRun && vertex.first_edge + kRun <= edges)
            for (std::uint32_t k = 0; k < kRun; ++k)
                look(first[k]);
        else
            std::for_each(first, first + vertex.degree, look);
        if (best == at)
            return best;
    }
}

} // namespace abut
