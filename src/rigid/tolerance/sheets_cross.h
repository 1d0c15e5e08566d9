#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <span>

namespace abut {

/// Decides whether two surfaces that bound no solids cross only with their borders: along each curve
/// in which they cross, one of them ends everywhere within `tolerance` of the other one.
///
/// A surface ends there if the part of it on one side of the curve is near the other surface as a
/// whole. That part is what can be reached from the curve without crossing the other surface.
///
/// In          contacts: all. `tolerance` is positive.
/// Degenerate  b is moved by 2^-40 of the pair's size first, so that no vertex of one surface lies on
///             the other one.
/// Accuracy    `fails`: along some curve both surfaces go on farther than `tolerance`. `open`: the
///             budget of the search is used up.
/// Cost        O(n log n) for surfaces of n triangles, and a search for each part beyond a curve.
Proof sheets_cross_at_most(const WorldSolid& a, const WorldSolid& b,
                           std::span<const Contact> contacts, double tolerance);

} // namespace abut
