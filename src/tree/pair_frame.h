#pragma once

#include "math/transform.h"
#include "tree/tree.h"

namespace abut {

/// How the boxes of one tree appear in another's frame, in single precision, with what that may be
/// off by.
struct FrameMap {
    float linear[3][3];    ///< [row][column]
    float magnitude[3][3]; ///< |linear|, for half extents
    float translation[3];
    float margin = 0;     ///< added to every gap's rounding: a gap is real beyond this
    float stretch_sq = 0; ///< a squared gap in the target frame is at least this times larger in
                          ///< the world (or equal)
    float most_stretch_sq = 0; ///< and at most this times
};

/// Two trees under their transforms: what a traversal of the pair needs to know.
struct PairFrame {
    FrameMap a_from_b{}; ///< takes b's boxes to a's frame
    FrameMap b_from_a{};
    bool valid = false; ///< false: a transform is singular and has no frame to compare in
};

/// Accuracy    the margins cover all rounding: of composing the transforms, of the world positions
///             that the exact kernels see, and of the traversal's single precision.
PairFrame make_pair_frame(const Tree& a, const Transform& world_from_a, const Tree& b,
                          const Transform& world_from_b);

} // namespace abut
