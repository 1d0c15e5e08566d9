#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// The shells of a surface: which triangles they have, and how these are oriented to each other.
struct ShellSets {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    std::uint32_t count = 0;             ///< of shells
    std::vector<std::uint32_t> shell_of; ///< by triangle; kNone for dropped and degenerate ones
    /// By triangle: it is oriented against the first triangle of its shell. Empty if none is.
    std::vector<bool> reversed;
    bool one_sided = false;    ///< a shell has only one side
    bool shares_edges = false; ///< an edge has more than two uses
};

/// Returns pairs of uses of an edge, each in opposite directions: going around the edge, matter begins
/// at the first triangle of a pair and ends at the second, and does not end in between. So what two
/// shells share there is not mixed up.
///
/// In          uses of one edge, as many upwards as downwards. sheet_of: if not empty, by triangle: a
///             number that triangles of one sheet have in common. Triangles on each other that face
///             the same way, as those of a face that two shells share are if one is turned inside
///             out, lie in the order of their sheets, so that each shell has its own.
/// Accuracy    exact.
std::vector<std::pair<HalfEdge, HalfEdge>> pair_uses(const Mesh& mesh,
                                                     std::span<const HalfEdge> uses,
                                                     std::span<const std::uint32_t> sheet_of = {});

/// In          as orient_shells.
/// Cost        O(n log n).
ShellSets find_shells(const Mesh& mesh, const Topology& topology, const std::vector<bool>& dropped);

} // namespace abut
