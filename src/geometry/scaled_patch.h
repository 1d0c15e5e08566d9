#pragma once

#include "geometry/nearest_on_patch.h"
#include "math/power_of_two.h"

#include <array>

namespace abut {

/// The patch of a pair at both ends in units in which nothing over- or underflows: the sizes of its
/// three vectors, each the largest coordinate at both ends, sum to at least 1/2 and less than 1.
///
/// Degenerate  all sizes are 0 where all vertices coincide always; the unit is then the least.
/// Accuracy    a coordinate at an end is off by 2^-53 of its vector's size.
struct ScaledPatch {
    FlatPatch start, end;
    int exponent = 0; ///< a length of 1 here is one of 2^exponent there

    /// Lengths of the pair to those here, and back.
    [[nodiscard]] double scaled(double length) const { return PowerOfTwo(-exponent) * length; }
    [[nodiscard]] double unscaled(double length) const { return PowerOfTwo(exponent) * length; }

    explicit ScaledPatch(const ElementaryPair& pair);

    /// Accuracy    off by 4 * 2^-53 of the vectors' sizes: the ends' rounding, 1 - t, product, sum.
    [[nodiscard]] FlatPatch at(double t) const;
};

} // namespace abut
