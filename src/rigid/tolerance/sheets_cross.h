#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <vector>

namespace abut {

/// How far two surfaces that bound no solids go beyond each other.
///
/// A surface goes beyond the other one on either side of a line in which they cross: what can be reached
/// from the line without crossing the other surface, and without leaving it over its border
/// (SheetBorder). How far is the greatest distance of a point there from the other surface. On the other
/// side it may go farther: the lesser one counts, and the greatest of it along the curve. Of the two
/// surfaces, again the lesser one counts, and of all curves the greatest.
struct SheetOverlap {
    Proof within = Proof::holds; ///< whether the depth is at most the tolerance
    double depth = 0;            ///< 0 if it is not more than the rounding
    Vec3 point;        ///< of one surface, in the world, that is so far from the other one
    bool of_b = false; ///< whether the point is on b
};

/// The contacts of two surfaces. A surface ends at all of them, but how far it goes is only asked along
/// those of faces that bound no solids.
struct SheetContacts {
    std::vector<Contact> of_sheets,
        of_solids; ///< the latter: of pairs of which one face bounds a solid
};

/// What overlap_of_sheets() is asked.
struct SheetSearch {
    double tolerance = 0; ///< positive
    double rounding = 0;  ///< how far the surfaces' points may lie from where they were, together
};

/// In          contacts: all. No vertex of one surface lies on the other one:
///             sheet_shift() moves b so that this is true.
/// Accuracy    `within`: `open` if the budget of a search is used up. A length that differs from the
///             tolerance by less than the rounding counts as the tolerance. `depth`: reached at the point,
///             and less than the rounding too small where the farthest point is a corner of a part; else
///             at most 2^-15 of it too small. It is the same for any triangles of the same surfaces. If a
///             budget is used up, it may be less.
/// Cost        O(n log n) for surfaces of n triangles, and some searches of each part beside a curve: one
///             for each length with which the depth is compared, up to 100.
SheetOverlap overlap_of_sheets(const WorldSolid& a, const WorldSolid& b,
                               const SheetContacts& contacts, const SheetSearch& search);

/// Returns a vector by which one of two surfaces is moved, so that their vertices and edges are in
/// general position: 2^-40 of the pair's size, in a fixed direction.
Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b);

} // namespace abut
