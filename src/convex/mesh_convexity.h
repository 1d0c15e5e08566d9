#pragma once

#include <abut/mesh.h>

#include "convex/body/convex_data.h"

namespace abut {

/// Checks that a mesh is the surface of its hull.
///
/// In          `hull`: the hull of the mesh's vertices. `dent`: a length; no shallower dent is
///             reported.
/// Errors      Error{bad_mesh} naming a triangle: the mesh is not closed, is flat, is turned inside
///             out, or has a dent.
void require_convex(const Mesh& mesh, const ConvexData& hull, double dent);

} // namespace abut
