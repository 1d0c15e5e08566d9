#pragma once

#include <abut/motion.h>

#include "world/body.h"

namespace abut {

/// A shape and how it moves; a deformable as its step says, whatever the motion.
struct MovingBody {
    const BodyShape& shape;
    const Box3& own_bounds;
    const Motion& motion;
};

/// Encloses a shape throughout its motion.
Box3 swept_bounds(const MovingBody& body);

/// When two bodies first meet.
///
/// Accuracy    never later than the first contact, and none is missed.
/// Source      two models: `time_of_impact`; with deformables: `deforming_impact`; else conservative
///             advancement [Mirtich 1996], between two convex bodies along the direction in which they are
///             apart [Zhang, Lee, Kim 2006].
Impact body_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options);

} // namespace abut
