#pragma once

#include "pieces/placed_pieces.h"

#include <optional>

namespace abut {

/// A point of the world that lies in both solids, if one of them, or a component of it, is inside of
/// the other.
///
/// In          solids no pieces of which meet.
/// Accuracy    exact: by the signs of the crossings of a ray.
std::optional<Vec3> contained_point(const PlacedPieces& placed);

} // namespace abut
