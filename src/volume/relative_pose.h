#pragma once

#include "math/transform.h"

namespace abut {

/// How one frame is seen from another, in single precision, with what that may be off by: takes a
/// volume of the one into the other.
struct RelativePose {
    float linear[3][3] = {}; ///< [row][column]
    float translation[3] = {};
    float most_stretch = 1; ///< no vector becomes longer than this times its length
    float margin = 0;       ///< a computed gap is real beyond this, in the target frame's units
    bool valid = false;     ///< false: singular, or of a size that single precision cannot square
};

/// In          to_from: affine, mirrors and shear included. reach_to, reach_from: no point of a
///             volume is farther from its frame's origin. slack: what positions may be off by
///             beyond that, in the target frame.
/// Accuracy    the margin covers the rounding of the transform to float and fewer than 64 roundings
///             of sums of terms that are below |linear| reach_from + |translation| + reach_to.
RelativePose make_relative_pose(const Transform& to_from, double reach_to, double reach_from,
                                double slack = 0);

} // namespace abut
