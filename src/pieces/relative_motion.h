#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// A ball that holds a body, in the body's frame.
struct BodyBall {
    Vec3 middle;
    double radius = 0;
};

/// Where two bodies stand.
struct PosePair {
    PosePair() = default;
    PosePair(const Transform& of_a, const Transform& of_b);

    Transform a, b;
    bool a_is_rigid = true, b_is_rigid = true; ///< to rounding
};

/// How much nearer any point of one body can have come to any point of the other between two pairs
/// of poses, at most.
///
/// In          finite transforms.
/// Accuracy    a proven bound, to rounding. Where a stands still, b's own motion; where both are
///             rigid, that of b as seen from a: so bodies that move together have not moved.
double most_approach(const PosePair& from, const PosePair& to, const BodyBall& a,
                     const BodyBall& b);

} // namespace abut
