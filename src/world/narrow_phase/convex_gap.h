#pragma once

#include <abut/convex.h>
#include <abut/world.h>

namespace abut {

/// The gap of two convex solids; minus the depth if they overlap. The ids are not set.
///
/// Accuracy    as `distance` and `penetration` of convex bodies. The normal is that of a motion that
///             separates the solids, also where they only touch; the witness points lie on them.
BodyGap convex_gap(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, ConvexWarmStart& warm_start);

} // namespace abut
