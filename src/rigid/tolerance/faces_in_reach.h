#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <functional>

namespace abut {

/// Calls visit(face) for the faces of a surface that a search cannot rule out by balls around them,
/// until it returns false.
///
/// In          box: of the points that matter; other faces are left out. `around`: how far from its
///             face a point that the search asks about may be.
void for_each_face_in_reach(const WorldSolid& surface, const Box3& box, double around,
                            ReachSearch& search, const std::function<bool(const Triangle&)>& visit);

} // namespace abut
