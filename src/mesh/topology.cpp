#include "mesh/topology.h"

#include <abut/error.h>

#include "core/disjoint_sets.h"
#include "math/vector.h"
#include "mesh/equal_positions.h"

#include <algorithm>
#include <string>
#include <utility>

namespace abut {

namespace {

bool same_edge(const HalfEdge& a, const HalfEdge& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}

/// Visits the sides of all triangles with three distinct merged vertices, in the order of the
/// triangles.
template <typename Visit>
void for_each_half_edge(const Mesh& mesh, const std::vector<std::uint32_t>& vertex_of,
                        const Visit& visit) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& v = mesh.triangles[i];
        const std::array<std::uint32_t, 3> m{vertex_of[v[0]], vertex_of[v[1]], vertex_of[v[2]]};
        if (m[0] == m[1] || m[1] == m[2] || m[2] == m[0])
            continue;
        visit(HalfEdge{m[0], m[1], i, v[2]});
        visit(HalfEdge{m[1], m[2], i, v[0]});
        visit(HalfEdge{m[2], m[0], i, v[1]});
    }
}

/// The half-edges sorted by lower vertex, upper vertex, triangle. A counting sort gives each lower
/// vertex its range, and the few half-edges in a range are sorted.
std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh,
                                        const std::vector<std::uint32_t>& vertex_of) {
    std::vector<std::size_t> end_of(vertex_of.size() + 1);
    for_each_half_edge(mesh, vertex_of, [&](const HalfEdge& e) { ++end_of[e.lower() + 1]; });
    std::partial_sum(end_of.begin(), end_of.end(), end_of.begin());
    std::vector<HalfEdge> sorted(end_of.back());
    // Each entry first holds where a range begins. Filling the range advances the entry to its end.
    for_each_half_edge(mesh, vertex_of,
                       [&](const HalfEdge& e) { sorted[end_of[e.lower()]++] = e; });
    std::size_t begin = 0;
    for (const std::size_t end : end_of) {
        std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
                  sorted.begin() + static_cast<std::ptrdiff_t>(end),
                  [](const HalfEdge& a, const HalfEdge& b) {
                      return std::pair(a.upper(), a.triangle) < std::pair(b.upper(), b.triangle);
                  });
        begin = end;
    }
    return sorted;
}

} // namespace

std::span<const HalfEdge> Topology::edge(std::uint32_t v, std::uint32_t w) const {
    const auto key = std::minmax(v, w);
    const auto [begin, end] = std::equal_range(
        half_edges.begin(), half_edges.end(), HalfEdge{key.first, key.second, 0, 0},
        [](const HalfEdge& a, const HalfEdge& b) {
            return std::pair(a.lower(), a.upper()) < std::pair(b.lower(), b.upper());
        });
    return {begin, end};
}

Topology make_topology(const Mesh& mesh) {
    Topology t;
    t.vertex_of = first_equal_positions(std::span(mesh.positions));
    t.half_edges = sorted_half_edges(mesh, t.vertex_of);
    return t;
}

bool is_closed(const Topology& topology) {
    const auto& e = topology.half_edges;
    if (e.empty() || e.size() % 2 != 0)
        return false;
    for (std::size_t i = 0; i < e.size(); i += 2)
        if (!same_edge(e[i], e[i + 1]) || (i > 0 && same_edge(e[i], e[i - 1])))
            return false;
    return true;
}

std::vector<std::uint32_t> vertex_components(const Mesh& mesh, const Topology& topology) {
    DisjointSets sets(topology.vertex_of);
    for (const auto& t : mesh.triangles)
        sets.unite(sets.unite(t[0], t[1]), t[2]);
    return std::move(sets).roots();
}

std::vector<std::uint32_t> component_representatives(const Mesh& mesh, const Topology& topology) {
    const std::vector<std::uint32_t> component = vertex_components(mesh, topology);
    std::vector<bool> seen(mesh.positions.size());
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t r = component[mesh.triangles[i][0]];
        if (!seen[r])
            result.push_back(i);
        seen[r] = true;
    }
    return result;
}

void require_valid_position(const Vec3& p, std::size_t vertex) {
    if (!is_finite(p))
        throw Error(ErrorCode::bad_mesh,
                    "vertex " + std::to_string(vertex) + " has a coordinate that is not finite");
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate)
        throw Error(ErrorCode::bad_mesh,
                    "vertex " + std::to_string(vertex) + " has a coordinate beyond 1e18");
}

void require_valid_positions(std::span<const Vec3> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        require_valid_position(positions[i], i);
}

void require_valid(const Mesh& mesh) {
    require_valid_positions(mesh.positions);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t v : mesh.triangles[i])
            if (v >= mesh.positions.size())
                throw Error(ErrorCode::bad_mesh, "triangle " + std::to_string(i) + " uses vertex " +
                                                     std::to_string(v) + " of " +
                                                     std::to_string(mesh.positions.size()));
}

} // namespace abut
