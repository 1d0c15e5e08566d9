#pragma once

#include "math/vector.h"

namespace abut {

/// The part of a triangle g over or under a triangle f.
struct FacesOverlay {
    double area = 0;   ///< of the part, seen along f's normal; 0: there is none
    double height = 0; ///< the largest distance of its points from f's plane
};

/// Bounds the errors of sides and volumes told by faces that are cut where they meet.
struct FacesUncertainty {
    double area = 0;   ///< of faces whose sides may be others: at borders of their parts
    double volume = 0; ///< between faces that are taken as one
};

/// Returns the part of g over or under f.
///
/// In          f: has an area. rim: what is nearer to f's border than this does not count.
/// Degenerate  nothing is over f if the planes are closer to right angles than to parallel.
/// Accuracy    to some roundings of the coordinates.
/// Cost        some dozens of products; fewer where g is beside f.
FacesOverlay faces_overlay(const Triangle& f, const Triangle& g, double rim);

} // namespace abut
