#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <cstdint>
#include <functional>

namespace abut {

/// Calls visit(face, number) for the faces of a surface that a search cannot rule out by balls around
/// them, until it returns false. The number is that of the face's triangle in the whole mesh. Faces
/// inside the solid that the surface bounds are left out, as far as they are known.
///
/// In          box: of the points that matter; other faces are left out. `around`: how far from its
///             face a point that the search asks about may be.
void for_each_face_in_reach(const WorldSolid& surface, const Box3& box, double around,
                            ReachSearch& search,
                            const std::function<bool(const Triangle&, std::uint32_t)>& visit);

} // namespace abut
