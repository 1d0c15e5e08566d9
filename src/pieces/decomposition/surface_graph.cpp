#include "pieces/decomposition/surface_graph.h"

#include <abut/error.h>

#include "math/predicates.h"
#include "mesh/topology.h"
#include "rigid/model/shell_sets.h"

#include <algorithm>
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

/// Errors      Error{bad_mesh} if the uses of an edge are no pairs in opposite directions.
void require_closed(const Mesh& mesh, const std::vector<HalfEdge>& uses) {
    if (uses.size() == 1)
        fail(mesh, uses[0], "is open: no other triangle uses it");
    if (uses.size() == 2 && uses[0].from == uses[1].from)
        fail(mesh, uses[0], "is used twice in one direction: one of its triangles is flipped");
    const auto up = std::ranges::count_if(uses, [](const HalfEdge& e) { return e.from < e.to; });
    if (2 * static_cast<std::size_t>(up) != uses.size())
        fail(mesh, uses[0], "is used by more than two triangles");
}

bool same_edge(const HalfEdge& e, const HalfEdge& f) {
    return e.lower() == f.lower() && e.upper() == f.upper();
}

} // namespace

SurfaceGraph::SurfaceGraph(const Mesh& mesh, const Solid& solid) : positions(mesh.positions) {
    const Topology& topology = solid.topology;
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
    std::vector<HalfEdge> uses;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        uses.clear();
        for (; end < edges.size() && same_edge(edges[begin], edges[end]); ++end)
            if (!solid.closed || solid.weights.empty() || solid.weights[edges[end].triangle] != 0)
                uses.push_back(edges[end]);
        if (!uses.empty())
            require_closed(mesh, uses);
        for (const auto& [e, f] : pair_uses(mesh, uses))
            set(e, f.triangle), set(f, e.triangle);
    }
}

bool SurfaceGraph::is_degenerate(std::uint32_t t) const {
    const Triangle c = triangle(t);
    return collinear(c[0], c[1], c[2]);
}

} // namespace abut
