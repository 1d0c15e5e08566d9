#pragma once

#include "mesh/representative_triangles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Triangles with their edges and representatives, which follow changes of the triangles. Work is
/// done only where triangles change.
class ChangingSurface {
public:
    /// In: indices below `vertices`; at most 2^30 triangles.
    ChangingSurface(std::size_t vertices, std::vector<IndexTriangle> triangles,
                    Assignment assignment);

    /// Takes other triangles. A triangle that has the same number and the same vertices in the same
    /// order as before keeps the numbers of its edges and the features that it represents. Every
    /// other feature is represented by the first of its triangles.
    ///
    /// In          indices below `vertices`.
    /// Cost        a comparison for each triangle; for each one that differs, proportional to the
    ///             number of triangles around its vertices.
    void set(std::size_t vertices, std::span<const IndexTriangle> triangles);

    [[nodiscard]] std::size_t vertices() const { return first_.size(); }
    [[nodiscard]] const std::vector<IndexTriangle>& triangles() const { return triangles_; }
    /// The edges' vertices, the lower one first. An edge that no triangle has any more is
    /// (kNoEdge, kNoEdge), until a new edge takes its number.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const {
        return features_.edges;
    }
    /// As SurfaceFeatures::edges_of.
    [[nodiscard]] const std::vector<IndexTriangle>& edges_of() const { return features_.edges_of; }
    [[nodiscard]] const std::vector<Represented>& represented() const { return represented_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    /// A corner of a triangle: 3 * triangle + k. The corners at a vertex form a linked list.
    using Corner = std::uint32_t;
    static constexpr Corner kNoCorner = 0xffffffffU;

    void link(std::uint32_t triangle);
    void unlink(std::uint32_t triangle);
    void remove(std::uint32_t triangle);
    void add(std::uint32_t triangle, const IndexTriangle& vertices);
    /// The number of an edge of the linked triangles; kNoEdge if there is none.
    [[nodiscard]] std::uint32_t find_edge(std::uint32_t v, std::uint32_t w) const;
    [[nodiscard]] std::uint32_t new_edge(std::uint32_t v, std::uint32_t w);
    /// Gives the features of a triangle's vertices and edges to their first triangles, unless they
    /// are represented.
    void represent(const IndexTriangle& triangle);
    template <typename Bit>
    void represent(std::uint32_t vertex, const Bit& bit_at);

    std::vector<IndexTriangle> triangles_;
    SurfaceFeatures features_;
    std::vector<Represented> represented_;
    std::vector<Corner> first_; ///< by vertex: a corner at it, or kNoCorner
    std::vector<Corner> next_;  ///< by corner: another one at the same vertex, or kNoCorner
    std::vector<std::uint32_t> free_edges_;
};

} // namespace abut
