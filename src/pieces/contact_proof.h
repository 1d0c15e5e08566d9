#pragma once

#include "convex/search/closest_points.h"
#include "pieces/placed_pieces.h"

namespace abut {

/// Whether it is proven that two solids share a point, where a search has found a common point of
/// two of their pieces. A search finds it to rounding; the solids are those that the placed vertices
/// of their triangles bound, each rounded for itself.
///
/// Pieces with a volume: if the hulls still meet when both shrink towards a ball inside of them, so
/// far that what is left of each lies deeper in it than rounding moves the surface, then there is a
/// point that both surfaces wind around. Other pieces: if two of their triangles meet, by exact signs,
/// where there are not many.
///
/// In          a pair of pieces and what a search found that ended with `meeting`.
bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const ClosestPointSearch& search);

/// The same for a common point found by simplices.
bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const DifferenceSimplex& simplex);

} // namespace abut
