#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <optional>
#include <span>

namespace abut {

/// Decides whether two surfaces that bound no solids cross only with their borders: along each curve
/// in which they cross, one of them ends everywhere within `tolerance` of the other one.
///
/// A surface ends there if the part of it on one side of the curve is near the other surface as a
/// whole. That part is what can be reached from the curve without crossing the other surface.
///
/// In          contacts: all. `tolerance` is positive. No vertex of one surface lies on the other one:
///             sheet_shift() moves b so that this is true.
/// Out         found: if it fails, a point of one surface, in the world, that goes on beyond the other
///             one farther than the tolerance.
/// Accuracy    `fails`: along some curve both surfaces go on farther than `tolerance`. `open`: the
///             budget of the search is used up.
/// Cost        O(n log n) for surfaces of n triangles, and a search for each part beyond a curve.
Proof sheets_cross_at_most(const WorldSolid& a, const WorldSolid& b,
                           std::span<const Contact> contacts, double tolerance,
                           std::optional<Vec3>* found = nullptr);

/// Returns a vector by which one of two surfaces is moved, so that their vertices and edges are in
/// general position: 2^-40 of the pair's size, in a fixed direction.
Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b);

} // namespace abut
