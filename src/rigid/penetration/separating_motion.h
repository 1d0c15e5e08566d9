#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// Share of the larger model by which positions are moved apart: far above their rounding, far
/// below anything built.
inline constexpr double kNudge = 0x1p-30;

/// A translation of b after which the surfaces share no point.
struct SeparatingMotion {
    double length = 0; ///< 0: none was found
    Vec3 direction;    ///< unit vector
};

/// A direction in which b, moved by 2^-30 of the pair's size, no longer meets a; zero if none was
/// found.
///
/// Accuracy    exact for the moved positions; the directions tried are the separating ones of the
///             contacts, the commonest first, their mean, and 26 evenly spread.
Vec3 nudge_that_parts(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts);

/// The shortest translation along the same directions that parts the surfaces, to 2^-24 of it.
SeparatingMotion find_separating_motion(const WorldSolid& a, const WorldSolid& b,
                                        std::span<const Contact> contacts);

} // namespace abut
