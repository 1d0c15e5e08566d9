#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The indices of the two nodes of an edge.
struct GraphEdge {
    std::uint32_t a = 0, b = 0;
};

/// Cuts a graph into `parts` subgraphs of about equal weight with few edges between them. Returns
/// the subgraph of each node. The result is the same on each run.
///
/// In          weights: of the nodes, at least 1; edges: no loops, each edge once; parts: at least
///             2.
/// Source      METIS, multi-level recursive bisection [Karypis, Kumar 1998].
std::vector<std::int32_t> cut_graph(std::span<const std::int32_t> weights,
                                    std::span<const GraphEdge> edges, int parts);

} // namespace abut
