#pragma once

#include "ccd/nearest_on_patch.h"
#include "math/power_of_two.h"

#include <array>

namespace abut {

/// The patch of a pair at both ends, in units in which nothing overflows or underflows: the sizes
/// of its three vectors (each the largest coordinate at both ends) sum to at least 1/2 and less
/// than 1.
///
/// Degenerate  if all vertices always coincide, all sizes are 0 and the unit is the smallest
///             possible.
/// Accuracy    a coordinate at an end is off by 2^-53 of its vector's size.
struct ScaledPatch {
    FlatPatch start, end;
    int exponent = 0; ///< a length of 1 here is 2^exponent in the pair's units

    /// Converts lengths from the pair's units to those of this patch, and back.
    [[nodiscard]] double scaled(double length) const { return PowerOfTwo(-exponent) * length; }
    [[nodiscard]] double unscaled(double length) const { return PowerOfTwo(exponent) * length; }

    explicit ScaledPatch(const ElementaryPair& pair);
    /// The patch of a pair at rest: that of a pair with these points at both ends.
    ScaledPatch(ElementaryKind kind, const std::array<Vec3, 4>& points);

    /// The patch at time t.
    ///
    /// Accuracy    off by 4 * 2^-53 of the vectors' sizes: rounding of the ends, 1 - t, product and
    ///             sum.
    [[nodiscard]] FlatPatch at(double t) const;
};

} // namespace abut
