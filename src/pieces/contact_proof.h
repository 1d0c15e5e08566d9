#pragma once

#include "convex/search/closest_points.h"
#include "pieces/placed_pieces.h"

namespace abut {

/// Returns whether it is proven that two solids share a point, after a search has found a common
/// point of two of their convex pieces. The search finds it only to rounding; the solids are
/// bounded by their triangles as placed, with each vertex rounded separately.
///
/// Pieces with a volume: both hulls shrink towards a ball inside them, so far that each remaining
/// hull lies deeper in the original than rounding moves the surface. If the remaining hulls still
/// meet, both surfaces wind around some common point. Other pieces: if exact signs show that two of
/// their triangles meet; tested only if there are few triangles.
///
/// In          a pair of pieces, and a search that ended with `meeting`.
bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const ClosestPointSearch& search);

/// The proof for a common point that GJK found.
bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const DifferenceSimplex& simplex);

} // namespace abut
