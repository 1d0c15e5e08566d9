#include "pieces/decomposition/surface_graph.h"

#include <abut/error.h>

#include "math/predicates.h"
#include "mesh/topology.h"

#include <fmt/format.h>

namespace abut {

namespace {

[[noreturn]] void fail(const Mesh& mesh, const HalfEdge& e, const char* what) {
    const Vec3 &p = mesh.positions[e.from], &q = mesh.positions[e.to];
    throw Error(
        ErrorCode::bad_mesh,
        fmt::format("not a solid: the edge of triangle {} from ({:g}, {:g}, {:g}) to ({:g}, {:g}, "
                    "{:g}) {}",
                    e.triangle, p.x, p.y, p.z, q.x, q.y, q.z, what));
}

bool same_edge(const HalfEdge& e, const HalfEdge& f) {
    return e.lower() == f.lower() && e.upper() == f.upper();
}

} // namespace

SurfaceGraph::SurfaceGraph(const Mesh& mesh) : positions(mesh.positions) {
    const Topology topology = make_topology(mesh);
    const auto& edges = topology.half_edges;
    if (edges.empty())
        throw Error(ErrorCode::bad_mesh, "not a solid: there is no triangle with three corners");
    corners.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        corners.push_back(
            {topology.vertex_of[t[0]], topology.vertex_of[t[1]], topology.vertex_of[t[2]]});
    across.assign(corners.size(), {kNoEdge, kNoEdge, kNoEdge});
    const auto set = [&](const HalfEdge& e, std::uint32_t beyond) {
        for (std::size_t k = 0; k < 3; ++k)
            if (corners[e.triangle][k] == e.from && corners[e.triangle][(k + 1) % 3] == e.to)
                across[e.triangle][k] = beyond;
    };
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const HalfEdge& e = edges[i];
        if (i + 1 == edges.size() || !same_edge(e, edges[i + 1]))
            fail(mesh, e, "is open: no other triangle uses it");
        const HalfEdge& f = edges[i + 1];
        if (i + 2 < edges.size() && same_edge(e, edges[i + 2]))
            fail(mesh, e, "is used by more than two triangles");
        if (e.from == f.from)
            fail(mesh, e, "is used twice in one direction: one of its triangles is flipped");
        set(e, f.triangle);
        set(f, e.triangle);
    }
}

bool SurfaceGraph::is_degenerate(std::uint32_t t) const {
    const Triangle c = triangle(t);
    return collinear(c[0], c[1], c[2]);
}

} // namespace abut
