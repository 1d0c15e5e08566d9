#pragma once

#include "math/vector.h"

#include <span>

namespace abut {

/// Finds a unit vector that leaves several faces which meet at a place: its dot product with each
/// of their normals is positive.
///
/// In          outward unit normals, of any number. Those of one face may occur several times.
/// Out         of all such vectors, about the one whose least dot product is largest: for two
///             faces, the bisector. Zero if there is none, as where two solids meet in a point; or
///             without normals.
/// Accuracy    the least dot product is at least 0.99 of the largest one, or the result is zero
///             although that is below 0.01.
/// Cost        two passes over the normals for one or two faces; some hundred where all normals are
///             nearly perpendicular to the result, and 2,000 at most.
/// Source      the vector sought is that from the origin to the nearest point of the normals' hull,
///             which [Gilbert 1966] finds.
Vec3 way_out(std::span<const Vec3> normals);

} // namespace abut
