#pragma once

#include "rigid/contacts.h"
#include "rigid/placed_solid.h"

#include <span>

namespace abut {

/// Whether two models that meet go into each other, or only touch.
///
/// Solids go into each other if a point of one's surface lies inside the other, or their interiors
/// share points along coplanar faces. Open surfaces do if one passes through the other.
///
/// In          all contacts of the pair.
/// Accuracy    exact where triangles cross and along edges, by orientation signs of stored points:
/// crossing triangles;
///             faces that pass through each other along an edge, however they are triangulated;
///             coplanar faces that turn the same way. Triangles that lie inside a solid and touch
///             its surface at vertices only are found by their vertices and middles.
bool interpenetrate(const PlacedSolid& a, const PlacedSolid& b, std::span<const Contact> contacts);

} // namespace abut
