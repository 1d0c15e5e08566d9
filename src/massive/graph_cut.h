#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Two nodes.
struct GraphEdge {
    std::uint32_t a = 0, b = 0;
};

/// Cuts a graph into parts of about equal weight with few edges between them; the part of each node.
///
/// In          weights: of the nodes, from 1; edges: no loops, each once; parts: at least 2.
/// Source      METIS, multi-level recursive bisection [Karypis, Kumar 1998]. The same on each run.
std::vector<std::int32_t> cut_graph(std::span<const std::int32_t> weights,
                                    std::span<const GraphEdge> edges, int parts);

} // namespace abut
