#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/placed_solid.h"

#include <span>

namespace abut {

/// Finds a translation of b after which the surfaces share no point and neither model lies inside
/// the other.
///
/// In          `directions`: unit vectors along which b may separate soon, likeliest first.
///             `at_least`: no shorter translation separates.
/// Accuracy    the translation separates: tested exactly, at b's transform with the translation
///             added to its last column. Along its direction it is the shortest to one part in 256,
///             or to 2^-30 of the models' size; another direction may be shorter. Zero only if
///             positions are so large that the sum does not change them.
/// In/out      steps: if given, limits the pairs of boxes that are opened; the result may then be
///             longer.
/// Cost        some 50 to 100 contact queries.
/// Source      PolyDepth [Je, Tang, Lee, Lee, Kim 2012]: move out, project onto the plane of the
///             last contact, move out again. Differs: bisection with exact contact tests replaces
///             continuous collision detection; it starts from the separation of the boxes, which
///             always exists.
Vec3 find_separation(const PlacedSolid& a, const PlacedSolid& b, std::span<const Vec3> directions,
                     double at_least, Counters& counters, SearchSteps* steps = nullptr);

/// A translation that separates, from the models' boxes alone.
Vec3 separation_of_boxes(const PlacedSolid& a, const PlacedSolid& b, Counters& counters);

} // namespace abut
