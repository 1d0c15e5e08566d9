#pragma once

#include <abut/deformable.h>

#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The features that a triangle represents: bit k for its vertex k, bit 3 + k for its edge k.
using Represented = std::uint8_t;

inline bool represents_vertex(Represented bits, std::size_t k) {
    return (bits >> k & 1) != 0;
}
inline bool represents_edge(Represented bits, std::size_t k) {
    return (bits >> (3 + k) & 1) != 0;
}

/// Triangles and their edges: the input of an assignment.
struct SurfaceView {
    std::size_t vertices = 0;
    std::span<const IndexTriangle> triangles;
    const SurfaceFeatures& features;
};

/// Assigns every used vertex, and every edge, to exactly one of its triangles.
///
/// Cost        O(n).
/// Source      [Curtis, Tamstorf, Manocha 2008]; maximal: [Wong, Baciu 2005]. Differs: maximal
///             takes triangles in passes, those with most features left first, and not at random.
std::vector<Represented> assign_features(const SurfaceView& surface, Assignment assignment);

/// Assigns every feature without a representative to its first triangle. Other assignments stay.
void complete_assignment(const SurfaceView& surface, std::span<Represented> represented);

/// Moves each feature of a marked triangle to the first of its triangles that is not marked, if
/// any.
void move_features_off(const SurfaceView& surface, const std::vector<bool>& marked,
                       std::span<Represented> represented);

} // namespace abut
