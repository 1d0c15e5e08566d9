#include <abut/mesh.h>

#include "math/predicates.h"
#include "math/vector.h"
#include "mesh/topology.h"

#include <algorithm>

namespace abut {

namespace {

std::size_t count_duplicates(const Mesh& mesh, const Topology& topology) {
    std::vector<std::array<std::uint32_t, 3>> sorted;
    sorted.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        sorted.push_back(
            {topology.vertex_of[t[0]], topology.vertex_of[t[1]], topology.vertex_of[t[2]]});
        std::sort(sorted.back().begin(), sorted.back().end());
    }
    std::sort(sorted.begin(), sorted.end());
    return static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
}

void count_edges(const Topology& topology, MeshReport& report) {
    const auto& e = topology.half_edges;
    for (std::size_t begin = 0, end = 0; begin < e.size(); begin = end) {
        end = begin + topology.edge(e[begin].from, e[begin].to).size();
        report.boundary_edges += end - begin == 1 ? 1 : 0;
        report.nonmanifold_edges += end - begin > 2 ? 1 : 0;
        report.flipped_edges += end - begin == 2 && e[begin].from == e[begin + 1].from ? 1 : 0;
    }
}

} // namespace

MeshReport inspect(const Mesh& mesh) {
    require_valid(mesh);
    const Topology topology = make_topology(mesh);
    MeshReport report;
    report.vertices = mesh.positions.size();
    report.triangles = mesh.triangles.size();
    for (std::uint32_t v = 0; v < topology.vertex_of.size(); ++v)
        report.distinct_vertices += topology.vertex_of[v] == v ? 1 : 0;
    for (const auto& t : mesh.triangles) {
        const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
        report.degenerate_triangles += collinear(p, q, r) ? 1 : 0;
        extend(report.bounds, p), extend(report.bounds, q), extend(report.bounds, r);
    }
    report.duplicate_triangles = count_duplicates(mesh, topology);
    count_edges(topology, report);
    report.components = component_representatives(mesh, topology).size();
    report.closed = is_closed(topology);
    return report;
}

} // namespace abut
