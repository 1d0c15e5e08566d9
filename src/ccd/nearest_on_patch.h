#pragma once

#include "ccd/difference_patch.h"

namespace abut {

/// The patch of difference_patch.h at one time. In its units, the sizes of the three vectors (each
/// the largest coordinate) sum to less than 1. Each coordinate may be off by 4 eps of its vector's
/// size, where eps is 2^-53.
struct FlatPatch {
    ElementaryKind kind = ElementaryKind::vertex_face;
    Vec3 corner, side_x, side_y;

    /// The corners in order around the patch. A triangle's last corner is repeated.
    ///
    /// Accuracy    a coordinate is off by 7 eps: 4 of the vectors, 2 of two sums, and underflow.
    [[nodiscard]] std::array<Vec3, 4> corners() const;
};

/// Error bound of the scalar product of a corner and a unit direction; a sum of two such products
/// has twice that. The direction's coordinates sum to at most 1.733, so a corner's error
/// contributes 1.733 * 7 eps. Three roundings of products and sums below 1.733 contribute 5.2 eps.
/// The sum of two products adds 3.5 eps.
constexpr double kAlongOff = 24 * 0x1p-53;

/// The point of a patch that is nearest to the origin.
struct NearestOnPatch {
    double distance = 0;         ///< approximate
    double lower = 0, upper = 0; ///< certified bounds
    double x = 0, y = 0;         ///< position in the patch
    /// From the origin to that point; its length is 1 to within 6 * 2^-53. All of the patch is at
    /// least `lower` away along it. Zero if `lower` is.
    Vec3 direction;
};

/// The point of a patch that is nearest to the origin, with certified bounds on its distance.
///
/// Degenerate  patches that are segments or points act as such.
/// Accuracy    `lower` and `upper` are certified. They differ by at most some 100 eps in general
///             position, and by less than 1e-12 in all tests of needles and nearly parallel edges.
/// Cost        some 60 to 110 ns; twice that for needles and nearly parallel edges.
/// Source      a direction along which a convex set is at least d away proves that its distance is
///             at least d. The direction to the nearest point proves the whole distance.
NearestOnPatch nearest_on_patch(const FlatPatch& patch);

/// A vector perpendicular to both sides of a patch, however small the angle between them: that of
/// their cross product, without its rounding error along the sides. Zero if the cross product is.
Vec3 normal_of_patch(const FlatPatch& patch);

} // namespace abut
