#pragma once

#include "mesh/topology.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The undirected edges of a mesh with their uses, and the edges of each triangle. Triangles can be
/// dropped one by one.
class SurfaceEdges {
public:
    SurfaceEdges(const Mesh& mesh, const Topology& topology);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(uses_.size()); }
    /// Returns all uses of an edge, those of dropped triangles included.
    [[nodiscard]] std::span<const HalfEdge> uses(std::uint32_t edge) const {
        return topology_.half_edges.empty()
                   ? std::span<const HalfEdge>()
                   : std::span(topology_.half_edges)
                         .subspan(begin_[edge], begin_[edge + 1] - begin_[edge]);
    }
    /// Returns the edges of a triangle. One with two equal vertices has none.
    [[nodiscard]] std::span<const std::uint32_t> edges_of(std::uint32_t triangle) const {
        return {edges_of_[triangle].data(), has_edges_[triangle] ? std::size_t{3} : 0};
    }

    [[nodiscard]] bool is_dropped(std::uint32_t triangle) const { return dropped_[triangle]; }
    void drop(std::uint32_t triangle);
    [[nodiscard]] const std::vector<bool>& dropped() const { return dropped_; }

    /// Returns the number of uses that are left.
    [[nodiscard]] std::uint32_t use_count(std::uint32_t edge) const {
        return uses_[edge].up + uses_[edge].down;
    }
    /// Returns how many more uses run upwards, from the lower to the upper vertex, than downwards.
    [[nodiscard]] int excess(std::uint32_t edge) const {
        return static_cast<int>(uses_[edge].up) - static_cast<int>(uses_[edge].down);
    }
    /// Returns whether the triangles that are left have no border at an edge. Two triangles may be
    /// oriented against each other; of more, as many run upwards as downwards.
    [[nodiscard]] bool is_closed_at(std::uint32_t edge) const {
        const std::uint32_t count = use_count(edge);
        return count == 0 || count == 2 || excess(edge) == 0;
    }

private:
    struct Uses {
        std::uint32_t up = 0, down = 0;
    };

    const Topology& topology_;
    std::vector<std::size_t> begin_; ///< by edge: its first half-edge; then their number
    std::vector<Uses> uses_;         ///< by edge, of triangles that are left
    std::vector<std::array<std::uint32_t, 3>> edges_of_;
    std::vector<bool> has_edges_, dropped_;
};

} // namespace abut
