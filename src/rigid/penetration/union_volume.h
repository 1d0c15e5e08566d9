#pragma once

#include "rigid/penetration/overlap_volume.h"

namespace abut {

/// The volume of a solid whose shells overlap: that of their union.
///
/// In          solid: has a boundary() of its own.
std::optional<OverlapVolume> union_volume(const WorldSolid& solid);

/// The volume that two solids have in common, if shells of one of them overlap. It is the integral
/// over the parts of all faces that have the common solid on one side only.
///
/// In          solids whose orientation is known.
/// Out         none if both have more than kMostOverlapTriangles triangles together, or if there
///             are too many parts (FaceFragments::for_each).
/// Accuracy    |volume - true volume| <= error: rounding, also of positions; what lies between faces
///             that coincide but for rounding; parts narrower than FaceFragments cuts off; and slits
///             at T-junctions.
/// Cost        O(n log n + pairs of faces that meet), and a ray for each part of a cut face.
std::optional<OverlapVolume> union_overlap_volume(const WorldSolid& a, const WorldSolid& b);

/// How far placed positions in a box may be off those that were meant: some roundings of the largest
/// coordinates.
double position_rounding(const Box3& box);

/// Returns none if the coordinates are so large that a product is beyond the range of numbers.
std::optional<OverlapVolume> finite_volume(double volume, double error);

} // namespace abut
