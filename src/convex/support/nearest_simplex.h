#pragma once

#include "convex/support/support_pair.h"
#include "math/double_double.h"

#include <optional>

namespace abut {

/// Keeps only the corners that span the point of a simplex that is nearest to the origin, with the
/// weights of that point.
///
/// Out         the point; none if the simplex is a tetrahedron that holds the origin. It keeps its
///             corners then.
/// Accuracy    of a thin simplex, the point may be far from the nearest one; it is a point of the
///             simplex to rounding.
std::optional<Vec3> reduce_to_nearest(SupportSimplex& simplex);

/// A point and the square of its distance from the origin.
struct PrecisePoint {
    Vec3 at;
    DoubleDouble distance_sq;
};

/// The same with 106 bits.
///
/// Accuracy    each coordinate of the point is relative to the point's own length, however thin the
///             simplex is, down to a height of 2^-40 of its length. `none` is a proof that the
///             corners hold the origin.
/// Cost        about 3 microseconds.
std::optional<PrecisePoint> reduce_to_nearest_precisely(SupportSimplex& simplex);

} // namespace abut
