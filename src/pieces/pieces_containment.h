#pragma once

#include "pieces/placed_pieces.h"

#include <optional>

namespace abut {

/// Returns a world point that lies in both solids, if one of them, or a component of it, lies
/// inside the other.
///
/// In          solids whose pieces do not meet.
/// Accuracy    exact: by the signs of a ray's crossings.
std::optional<Vec3> contained_point(const PlacedPieces& placed);

} // namespace abut
