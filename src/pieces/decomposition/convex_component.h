#pragma once

#include "pieces/decomposition/surface_graph.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The components of a surface that are convex as a whole, and have nothing inside: each as the list
/// of its triangles.
///
/// In          the model of the surface, as it is.
/// Accuracy    exact for what is said to be convex. One that has others in its box may be left out.
/// Cost        O(n log n).
std::vector<std::vector<std::uint32_t>> convex_components(const PlacedModel& model,
                                                          const SurfaceGraph& surface);

} // namespace abut
