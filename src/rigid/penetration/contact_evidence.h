#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// How two models that meet do so.
struct Meeting {
    bool interpenetrate = false;
    Vec3 parting; ///< a unit vector along which a small step of b parts them, if one was found;
                  ///< else zero
};

/// Whether two models that meet go into each other, or only touch.
///
/// They do if triangles cross, or a part of one's surface lies inside the other, a solid. Else, two
/// solids do if their interiors share points (coplanar faces that turn the same way, faces that
/// enter along an edge); where one of the two is open, if no small translation parts them: which
/// side of an open surface is meant is not known, so being locked counts as going through.
///
/// In          all contacts of the pair.
/// Accuracy    crossing, inside at stored vertices, overlap along edges: exact, by orientation
///             signs of stored points. Triangles that lie inside a solid and touch its surface at
///             vertices only are found by their middles.
Meeting examine_meeting(const WorldSolid& a, const WorldSolid& b,
                        std::span<const Contact> contacts);

} // namespace abut
