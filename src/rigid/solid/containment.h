#pragma once

#include "rigid/solid/placed_solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Marks the triangles of `inner` that belong to components which lie inside `outer`, a solid;
/// empty if there are none.
///
/// In          `touched`: triangles of `inner` that meet the other's surface, all of them.
/// Accuracy    exact for a closed `outer`: one vertex of a component decides for all of it.
std::vector<bool> contained_triangles(const PlacedSolid& inner, const PlacedSolid& outer,
                                      const std::vector<std::uint32_t>& touched);

/// Whether a component of `inner` lies inside `outer`, a solid. In: their surfaces do not meet.
bool any_component_inside(const PlacedSolid& inner, const PlacedSolid& outer);

} // namespace abut
