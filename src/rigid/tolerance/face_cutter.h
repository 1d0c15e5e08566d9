#pragma once

#include "math/vector.h"
#include "rigid/tolerance/line_piece.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Cuts a triangle into convex pieces, so that each of some line pieces in it lies on sides of them. A
/// cut goes on beyond the end of a line piece, to the other sides of the piece that it ends in.
///
/// In          normal: of the triangle, unit. near: a corner that is no farther from a line than that is
///             on it; so no cut makes a piece that is thinner.
/// Cost        the pieces that a line piece passes through, and a search for them.
/// Source      binary space partition by the line pieces, in an order that has nothing to do with
///             theirs.
std::vector<std::vector<Vec3>> pieces_of_face(const Triangle& face, const Vec3& normal,
                                              std::span<const DirectedPiece> lines, double near);

} // namespace abut
