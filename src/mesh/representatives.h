#pragma once

#include <abut/deformable.h>

#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// What a triangle represents: bit k its vertex k, bit 3 + k its edge k.
using Represented = std::uint8_t;

inline bool represents_vertex(Represented bits, std::size_t k) {
    return (bits >> k & 1) != 0;
}
inline bool represents_edge(Represented bits, std::size_t k) {
    return (bits >> (3 + k) & 1) != 0;
}

/// Triangles and their edges, which is all that an assignment depends on.
struct SurfaceView {
    std::size_t vertices = 0;
    std::span<const IndexTriangle> triangles;
    const SurfaceFeatures& features;
};

/// Gives every vertex that a triangle uses, and every edge, to exactly one of its triangles.
///
/// Cost        O(n).
/// Source      [Curtis, Tamstorf, Manocha 2008]; maximal: [Wong, Baciu 2005]. Differs: maximal takes
///             triangles in passes, by how much is left to represent, and not at random.
std::vector<Represented> assign_features(const SurfaceView& surface, Assignment assignment);

/// Gives every feature that no triangle represents to its first triangle; others stay.
void complete_assignment(const SurfaceView& surface, std::span<Represented> represented);

/// Moves features from triangles that are marked to the first of their triangles that is not.
void move_features_off(const SurfaceView& surface, const std::vector<bool>& marked,
                       std::span<Represented> represented);

} // namespace abut
