#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/placed_solid.h"

#include <span>

namespace abut {

/// A translation of b after which the surfaces share no point and neither lies inside the other.
///
/// In          `directions`: unit vectors in which b might get out soon, likeliest first; no
///             translation shorter than `at_least` separates.
/// Accuracy    it separates: tested exactly, at b's transform with the translation added to its
///             last column. Short, along its direction within one part in 256 or 2^-30 of the
///             models' size, not always the shortest. Zero only if positions are too large for the
///             sum to change them.
/// In/out      steps: if given, limits the pairs of boxes that are opened; what is found may then be
///             longer.
/// Cost        some 50 to 100 contact queries.
/// Source      [Je, Tang, Lee, Lee, Kim 2012], PolyDepth: go out, project onto the plane of the
///             last contact, go out again. Differs: a bisection against exact contact in place of
///             continuous collision; starts from the boxes' way out, which always exists.
Vec3 find_separation(const PlacedSolid& a, const PlacedSolid& b, std::span<const Vec3> directions,
                     double at_least, Counters& counters, SearchSteps* steps = nullptr);

/// The same, from the models' boxes alone.
Vec3 separation_of_boxes(const PlacedSolid& a, const PlacedSolid& b, Counters& counters);

} // namespace abut
