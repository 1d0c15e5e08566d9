#pragma once

#include "rigid/solid/placed_solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Marks the triangles of those components of `inner` that lie inside `outer`, a solid. Returns an
/// empty list if there are none.
///
/// In          `touched`: all triangles of `inner` that meet the surface of `outer`.
/// Accuracy    exact for a closed `outer`: one vertex of a component decides for all of it.
std::vector<bool> contained_triangles(const PlacedSolid& inner, const PlacedSolid& outer,
                                      const std::vector<std::uint32_t>& touched);

/// Returns whether a component of `inner` lies inside `outer`, a solid.
///
/// In          the surfaces do not meet.
bool any_component_inside(const PlacedSolid& inner, const PlacedSolid& outer);

} // namespace abut
