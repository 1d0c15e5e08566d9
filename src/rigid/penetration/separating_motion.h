#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// The step by which positions are moved apart, as a share of the larger model: far above rounding,
/// far below manufacturing precision.
inline constexpr double kNudge = 0x1p-30;

/// A translation of b after which the surfaces share no point.
struct SeparatingMotion {
    double length = 0; ///< 0: none was found
    Vec3 direction;    ///< unit vector
};

/// Returns a direction in which b, moved by 2^-30 of the pair's size, no longer meets a; zero if
/// none was found.
///
/// Accuracy    exact for the moved positions. The directions tried are those that separate the
///             contacts' triangles, the most frequent first; their mean; and 26 evenly spread ones.
Vec3 nudge_that_parts(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts);

/// The shortest translation along the same directions that parts the surfaces, to 2^-24 of its
/// length.
SeparatingMotion find_separating_motion(const WorldSolid& a, const WorldSolid& b,
                                        std::span<const Contact> contacts);

} // namespace abut
