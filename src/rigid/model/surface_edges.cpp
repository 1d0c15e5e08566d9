#include "rigid/model/surface_edges.h"

namespace abut {

SurfaceEdges::SurfaceEdges(const Mesh& mesh, const Topology& topology)
    : topology_(topology), edges_of_(mesh.triangles.size()), has_edges_(mesh.triangles.size()),
      dropped_(mesh.triangles.size()) {
    const std::vector<HalfEdge>& half_edges = topology.half_edges;
    std::vector<std::uint8_t> known(mesh.triangles.size());
    for (std::size_t i = 0; i < half_edges.size(); ++i) {
        const HalfEdge& e = half_edges[i];
        if (i == 0 || e.lower() != half_edges[i - 1].lower() ||
            e.upper() != half_edges[i - 1].upper()) {
            begin_.push_back(i);
            uses_.emplace_back();
        }
        ++(e.from < e.to ? uses_.back().up : uses_.back().down);
        edges_of_[e.triangle].at(known[e.triangle]++) =
            static_cast<std::uint32_t>(uses_.size() - 1);
        has_edges_[e.triangle] = true;
    }
    begin_.push_back(half_edges.size());
}

void SurfaceEdges::drop(std::uint32_t triangle) {
    if (dropped_[triangle])
        return;
    dropped_[triangle] = true;
    for (const std::uint32_t edge : edges_of(triangle))
        for (const HalfEdge& e : uses(edge))
            if (e.triangle == triangle)
                --(e.from < e.to ? uses_[edge].up : uses_[edge].down);
}

} // namespace abut
