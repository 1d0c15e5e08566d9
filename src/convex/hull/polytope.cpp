#include "convex/hull/polytope.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// The side from -> to of a triangle whose third corner is `apex`. In the ring around `from`, the
/// edge to `apex` follows that to `to`.
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

/// Puts the corners around one vertex, which are sorted by `to`, into ring order.
void order_ring(std::span<Corner> ring) {
    const std::vector<Corner> sorted(ring.begin(), ring.end());
    for (std::size_t i = 1; i < ring.size(); ++i)
        ring[i] =
            *std::lower_bound(sorted.begin(), sorted.end(), ring[i - 1].apex,
                              [](const Corner& c, std::uint32_t vertex) { return c.to < vertex; });
}

void add_ring(std::span<const Vec3> points, std::span<const Corner> ring,
              std::vector<RingBatch>& rings) {
    for (std::size_t first = 0; first < ring.size(); first += RingBatch::kEdges) {
        RingBatch& batch = rings.emplace_back();
        for (std::size_t k = 0; k < RingBatch::kEdges; ++k) {
            const std::uint32_t to = ring[first + k < ring.size() ? first + k : 0].to;
            batch.target[k] = to;
            batch.x[k] = points[to].x, batch.y[k] = points[to].y, batch.z[k] = points[to].z;
        }
    }
}

/// Pads the rings so that two batches can be read where the last one begins. The padding repeats a
/// vertex.
void add_room(Polytope& polytope) {
    RingBatch last;
    const Vec3& at = polytope.vertices[0].at;
    last.x.fill(at.x), last.y.fill(at.y), last.z.fill(at.z);
    while (polytope.edge_end() < polytope.vertices.back().first_edge + 2 * RingBatch::kEdges)
        polytope.rings.push_back(last);
}

void add_columns(std::span<const Vec3> points, std::vector<double>& columns) {
    const std::size_t batches = (points.size() + RingBatch::kEdges - 1) / RingBatch::kEdges;
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < batches * RingBatch::kEdges; ++i)
            columns.push_back(component(points[std::min(i, points.size() - 1)], axis));
}

void set_twins(Polytope& polytope) {
    struct Ends {
        std::uint32_t low, high, edge;
    };
    std::vector<Ends> ends;
    for (std::uint32_t v = 0; v < polytope.vertices.size(); ++v) {
        const HullVertex& vertex = polytope.vertices[v];
        for (std::uint32_t e = vertex.first_edge; e < vertex.first_edge + vertex.degree; ++e) {
            const std::uint32_t w = polytope.target(e);
            ends.push_back({std::min(v, w), std::max(v, w), e});
        }
    }
    std::sort(ends.begin(), ends.end(), [](const Ends& a, const Ends& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    const auto twin = [&](std::uint32_t edge) -> std::uint32_t& {
        return polytope.rings[edge / RingBatch::kEdges].twin[edge % RingBatch::kEdges];
    };
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        twin(ends[i].edge) = ends[i + 1].edge;
        twin(ends[i + 1].edge) = ends[i].edge;
    }
}

} // namespace

Polytope make_polytope(std::span<const Vec3> points, std::span<const IndexTriangle> triangles) {
    std::vector<Corner> corners = corners_by_vertex(triangles);
    if (triangles.empty() && points.size() == 2)
        corners = {{0, 1, 1}, {1, 0, 0}};
    Polytope polytope;
    polytope.vertices.reserve(points.size());
    auto ring = corners.begin();
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        const auto end =
            std::find_if(ring, corners.end(), [v](const Corner& c) { return c.from != v; });
        order_ring({ring, end});
        polytope.vertices.push_back(
            {points[v], polytope.edge_end(), static_cast<std::uint32_t>(end - ring)});
        add_ring(points, {ring, end}, polytope.rings);
        ring = end;
    }
    add_room(polytope);
    set_twins(polytope);
    if (points.size() <= Polytope::kSmall)
        add_columns(points, polytope.columns);
    return polytope;
}

std::size_t Polytope::bytes() const {
    return vertices.capacity() * sizeof(HullVertex) + rings.capacity() * sizeof(RingBatch) +
           starts.vertices().capacity() * sizeof(std::uint32_t) +
           columns.capacity() * sizeof(double);
}

} // namespace abut
