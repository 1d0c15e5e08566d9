#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// How two models that share points meet.
struct Meeting {
    bool interpenetrate = false;
    /// A unit vector along which a small step of b parts the models; zero if none was
    /// found.
    Vec3 parting;
};

/// Decides whether two models that share points interpenetrate or only touch.
///
/// They interpenetrate if triangles cross, or if a part of one surface lies inside the other model,
/// a solid. Otherwise, a small translation that parts them shows that they only touch. If none is
/// found, two solids interpenetrate if their interiors share points (coplanar faces that face the
/// same way, or faces that enter along an edge). If one of the two is open, its inner side is not
/// known, so being locked counts as interpenetration.
///
/// In          all contacts of the pair.
/// Accuracy    crossings, stored vertices inside, and overlaps along edges are exact, by
///             orientation signs of stored points. Triangles inside a solid that touch its surface
///             only at their vertices are found by their centroids.
Meeting examine_meeting(const WorldSolid& a, const WorldSolid& b,
                        std::span<const Contact> contacts);

} // namespace abut
