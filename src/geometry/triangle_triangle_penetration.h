#pragma once

#include "math/vector.h"

namespace abut {

/// The shortest translation that ends the overlap of two triangles.
struct TriangleSeparation {
    double depth = 0; ///< its length; 0 or a rounding residue if the triangles only touch
    Vec3 direction;   ///< unit vector along which b moves; zero if both triangles are points
};

/// The shortest translation that ends the overlap of two triangles.
///
/// In          two triangles that share a point.
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    to rounding. For the surfaces that the triangles belong to, it is only a lower
///             bound.
/// Source      faces of the Minkowski difference: two normals and nine edge pairs [Gottschalk et
///             al. 1996].
TriangleSeparation triangle_triangle_penetration(const Triangle& a, const Triangle& b);

} // namespace abut
