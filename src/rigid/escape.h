#pragma once

#include "rigid/contacts.h"
#include "rigid/placed_solid.h"

#include <span>

namespace abut {

/// A translation of b after which the surfaces share no point.
struct Escape {
    double length = 0; ///< 0: none was found
    Vec3 direction;    ///< unit vector
};

/// Whether b, moved by 2^-30 of the pair's size in some direction, no longer meets a.
///
/// Accuracy    a yes is exact for the moved positions; the directions tried are the separating ones
/// of the contacts,
///             their mean, and 26 evenly spread.
bool parted_by_a_nudge(const PlacedSolid& a, const PlacedSolid& b,
                       std::span<const Contact> contacts);

/// The shortest translation along the same directions that parts the surfaces, within one part in
/// 256.
Escape find_escape(const PlacedSolid& a, const PlacedSolid& b, std::span<const Contact> contacts);

} // namespace abut
