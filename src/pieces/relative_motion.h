#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// A ball around a body, in the body's frame.
struct BodyBall {
    Vec3 middle;
    double radius = 0;
};

/// The poses of two bodies.
struct PosePair {
    PosePair() = default;
    PosePair(const Transform& of_a, const Transform& of_b);

    Transform a, b;
    bool a_is_rigid = true, b_is_rigid = true; ///< to rounding
};

/// Bounds how much nearer any point of one body can have come to any point of the other between two
/// pairs of poses.
///
/// In          finite transforms.
/// Accuracy    proven, to rounding. If a stands still, the bound is that of b's own motion. If both
///             are rigid, it is that of b's motion relative to a, so bodies that move together have
///             not approached.
double most_approach(const PosePair& from, const PosePair& to, const BodyBall& a,
                     const BodyBall& b);

} // namespace abut
