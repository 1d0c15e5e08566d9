#pragma once

#include <abut/deformable.h>
#include <abut/motion.h>

#include "world/schedule/body_impact.h"

namespace abut {

/// The first impact of a deformable surface, body a, and a half-space that do not touch at the
/// start.
///
/// Accuracy    never later than the first contact, and no contact is missed.
/// Source      conservative advancement of the vertices, whose paths are straight. If the half-space
///             does not turn, each vertex meets its plane at the root of a linear function.
Impact half_space_impact(const Deformable& surface, const MovingBody& half_space,
                         const ImpactOptions& options);

} // namespace abut
