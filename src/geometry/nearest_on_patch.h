#pragma once

#include "geometry/difference_patch.h"

namespace abut {

/// The patch of difference_patch.h at one time, in units in which the sizes of its three vectors,
/// each its largest coordinate, sum to less than 1. A coordinate of theirs may be off by 4 eps of
/// the size, eps being 2^-53.
struct FlatPatch {
    ElementaryKind kind = ElementaryKind::vertex_face;
    Vec3 corner, side_x, side_y;

    /// In order around it; a triangle's last twice.
    /// Accuracy    a coordinate is off by 7 eps: 4 of the vectors, two sums' 2, and underflow.
    [[nodiscard]] std::array<Vec3, 4> corners() const;
};

/// What the scalar product of a corner and a direction of length 1 may be off by, and a sum of two
/// of them by twice as much. The coordinates of such a direction sum to at most 1.733, so a corner's
/// error makes 1.733 * 7 eps, and three roundings of products and sums below 1.733 make 5.2 eps; the
/// sum of two adds 3.5 eps.
constexpr double kAlongOff = 24 * 0x1p-53;

/// The point of a patch that is nearest to the origin.
struct NearestOnPatch {
    double distance = 0;         ///< about
    double lower = 0, upper = 0; ///< certainly not below, not above
    double x = 0, y = 0;         ///< where it is
    /// From the origin to it, of length 1 but for 6 * 2^-53: all of the patch is at least `lower`
    /// away along it. Zero where `lower` is.
    Vec3 direction;
};

/// Degenerate  patches that are segments or points act as such.
/// Accuracy    `lower` and `upper` are certified. They differ by some 100 eps at most in general
///             position, and by less than 1e-12 in all tests of needles and nearly parallel edges.
/// Cost        some 60 to 110 ns; twice as much of needles and nearly parallel edges.
/// Source      a direction along which a convex set is at least d away proves its distance; that to
///             the nearest point proves all of it.
NearestOnPatch nearest_on_patch(const FlatPatch& patch);

} // namespace abut
