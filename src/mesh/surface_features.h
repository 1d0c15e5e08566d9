#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

using IndexTriangle = std::array<std::uint32_t, 3>;

/// Stands for an edge that does not exist.
inline constexpr std::uint32_t kNoEdge = 0xffffffffU;

/// The edges of indexed triangles.
struct SurfaceFeatures {
    /// Each pair of vertices that a triangle connects, once: (lower, higher), sorted by higher,
    /// then by lower index.
    std::vector<std::array<std::uint32_t, 2>> edges;
    /// The three edges of each triangle. Edge k runs from its vertex k to its vertex k + 1 (mod 3).
    /// It is kNoEdge if both are the same vertex.
    std::vector<IndexTriangle> edges_of;
};

/// Finds the edges of triangles.
/// In          indices below `vertices`.
/// Cost        O(n), plus sorting the edges at each vertex.
SurfaceFeatures make_surface_features(std::size_t vertices,
                                      std::span<const IndexTriangle> triangles);

} // namespace abut
