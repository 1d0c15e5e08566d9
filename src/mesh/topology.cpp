#include "mesh/topology.h"

#include <abut/error.h>

#include "math/vector.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

namespace abut {

namespace {

bool same_edge(const HalfEdge& a, const HalfEdge& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}

std::vector<std::uint32_t> merge_equal_positions(const Mesh& mesh) {
    const auto& positions = mesh.positions;
    std::vector<std::uint32_t> sorted(positions.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t i, std::uint32_t j) {
        const Vec3 &p = positions[i], &q = positions[j];
        return std::tie(p.x, p.y, p.z, i) < std::tie(q.x, q.y, q.z, j);
    });
    std::vector<std::uint32_t> vertex_of(positions.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        vertex_of[sorted[i]] = i > 0 && positions[sorted[i]] == positions[sorted[i - 1]]
                                   ? vertex_of[sorted[i - 1]]
                                   : sorted[i];
    return vertex_of;
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
    t.vertex_of = merge_equal_positions(mesh);
    t.half_edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& v = mesh.triangles[i];
        const std::array<std::uint32_t, 3> m{t.vertex_of[v[0]], t.vertex_of[v[1]],
                                             t.vertex_of[v[2]]};
        if (m[0] == m[1] || m[1] == m[2] || m[2] == m[0])
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            t.half_edges.push_back({m[k], m[(k + 1) % 3], i, v[(k + 2) % 3]});
    }
    std::sort(t.half_edges.begin(), t.half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tuple(a.lower(), a.upper(), a.triangle) <
               std::tuple(b.lower(), b.upper(), b.triangle);
    });
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
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 1; k < 3; ++k)
            parent[root(topology.vertex_of[t[k]])] = root(topology.vertex_of[t[0]]);
    std::vector<std::uint32_t> result(mesh.positions.size());
    for (std::uint32_t v = 0; v < result.size(); ++v)
        result[v] = root(topology.vertex_of[v]);
    return result;
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

void require_valid(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3& p = mesh.positions[i];
        if (!is_finite(p))
            throw Error(ErrorCode::bad_mesh,
                        "vertex " + std::to_string(i) + " has a coordinate that is not finite");
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate)
            throw Error(ErrorCode::bad_mesh,
                        "vertex " + std::to_string(i) + " has a coordinate beyond 1e18");
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t v : mesh.triangles[i])
            if (v >= mesh.positions.size())
                throw Error(ErrorCode::bad_mesh, "triangle " + std::to_string(i) + " uses vertex " +
                                                     std::to_string(v) + " of " +
                                                     std::to_string(mesh.positions.size()));
}

} // namespace abut
