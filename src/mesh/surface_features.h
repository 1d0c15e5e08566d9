#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

using IndexTriangle = std::array<std::uint32_t, 3>;

/// In place of an edge's number: there is none.
inline constexpr std::uint32_t kNoEdge = 0xffffffffU;

/// The edges of indexed triangles.
struct SurfaceFeatures {
    /// Each pair of vertices that a triangle joins, once: (lower, higher), sorted by the higher
    /// index, then by the lower.
    std::vector<std::array<std::uint32_t, 2>> edges;
    /// Three of each triangle: edge k runs from its vertex k to its vertex k + 1 (mod 3). kNoEdge where
    /// both are the same vertex.
    std::vector<IndexTriangle> edges_of;
};

/// In          indices below `vertices`.
/// Cost        O(n) but for the sorting of the edges at one vertex.
SurfaceFeatures make_surface_features(std::size_t vertices,
                                      std::span<const IndexTriangle> triangles);

} // namespace abut
