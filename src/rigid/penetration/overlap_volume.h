#pragma once

#include "rigid/solid/world_solid.h"

#include <optional>

namespace abut {

/// A volume, and how much larger or smaller the true one may be.
struct OverlapVolume {
    double volume = 0, error = 0; ///< cubic units of the world
};

/// The volume that two solids have in common.
///
/// The method integrates over the boundary of the common solid: over the parts of each surface that
/// lie inside the other solid. Where the surfaces cross is decided exactly. So that no face lies
/// in another one, b is moved by a tiny vector first; the error contains what that changes.
///
/// If shells of a solid overlap, union_volume.h has the volume of their union.
///
/// In          a, b: solids whose orientation is known. Where one shell passes through itself and
///             winds twice around a region, the region counts twice.
/// Out         none if a surface bounds no solid or is not oriented, if the surfaces do not decide
///             what is inside, or if more triangles than kMostOverlapTriangles of one surface reach
///             the other one's box. None if it is not known whether shells overlap
///             (WorldSolid::knows_boundary).
/// Accuracy    |volume - true volume| <= error. Closed surfaces: usually below 1e-9 of the product
///             of the common box's diagonal and the area in it. Surfaces with T-junctions: 1e-6 of
///             it.
/// Cost        O((m + n) log n + crossings) for m and n triangles in the common box.
/// Source      the integral over faces is that of [Mirtich 1996] for volumes; the boundary is not
///             built, because the sums over its edges do not need their order.
std::optional<OverlapVolume> overlap_volume(const WorldSolid& a, const WorldSolid& b);

inline constexpr std::size_t kMostOverlapTriangles = 200'000;

/// The volume of a solid, of a union if shells overlap. Out: none if the surface bounds no solid or is
/// not oriented, or as above.
std::optional<OverlapVolume> solid_volume(const WorldSolid& solid);

} // namespace abut
