#pragma once

#include <abut/motion.h>

#include "world/schedule/moving_body.h"

namespace abut {

/// A box that encloses a shape throughout its motion.
Box3 swept_bounds(const MovingBody& body);

/// The first impact of two bodies.
///
/// Accuracy    never later than the first contact, and no contact is missed.
/// Source      two models: `time_of_impact`; with deformables: `deforming_impact`; a model and a ball,
///             capsule, box or convex body: `core_impact`; else
///             conservative advancement [Mirtich 1996]. Between two convex bodies it uses the speed
///             along the direction in which they are apart [Zhang, Lee, Kim 2006].
Impact body_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options);

/// The impact of the two bodies in the other order.
Impact turned_round(Impact impact);

} // namespace abut
