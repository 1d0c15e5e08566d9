#pragma once

#include "math/transform.h"

namespace abut {

/// The pose of one frame in another, in single precision, with a margin for its rounding. It takes
/// volumes of the one frame into the other.
struct RelativePose {
    float linear[3][3] = {}; ///< [row][column]
    float translation[3] = {};
    float most_stretch = 1; ///< upper bound of a vector's stretch
    float margin = 0;       ///< a computed gap larger than this is real; in the target frame's
                            ///< units
    bool valid = false;     ///< false: singular, or of a size that single precision cannot square
};

/// Computes the pose of a source frame in a target frame.
/// In          to_from: affine, may mirror and shear. reach_to, reach_from: upper bounds of the
///             volumes' distances from their frames' origins. slack: further error of positions, in
///             the target frame.
/// Accuracy    the margin covers the rounding of the transform to float, and fewer than 64
///             roundings of sums whose terms are below |linear| reach_from + |translation| +
///             reach_to.
RelativePose make_relative_pose(const Transform& to_from, double reach_to, double reach_from,
                                double slack = 0);

} // namespace abut
