#pragma once

#include <abut/scene.h>

namespace abut {

/// False if a coordinate of a part could leave the range of doubles. Positions are in the range of
/// floats.
bool stays_finite(const Transform& transform);

/// Whether one triangle at least, in world coordinates, is not exactly degenerate. In any usual
/// mesh the first one is.
///
/// In          indices in range.
bool has_area(const Mesh& mesh, const Transform& world_from_mesh);

} // namespace abut
