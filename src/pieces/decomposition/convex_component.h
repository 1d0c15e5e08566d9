#pragma once

#include "pieces/decomposition/surface_graph.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Finds the components of a surface that are convex as a whole and have nothing inside. Returns
/// the triangles of each.
///
/// In          a model of the surface, untransformed.
/// Accuracy    what is returned is exactly convex. A convex component with other triangles in or
///             near its box is left out.
/// Cost        O(n log n).
std::vector<std::vector<std::uint32_t>> convex_components(const PlacedModel& model,
                                                          const SurfaceGraph& surface);

} // namespace abut
