#pragma once

#include "world/schedule/body_impact.h"

namespace abut {

/// The first impact of two bodies, at least one of which is a deformable surface in its current
/// step.
///
/// Accuracy    never later than the first contact, and no contact is missed. Two deformables:
///             exact, as `time_of_impact`.
/// Source      two deformables: docs/representative-triangles.md. Else moving boxes, subdivided in
///             space and time [Snyder et al. 1993], and conservative advancement of two triangles
///             [Mirtich 1996] along the direction in which they are apart.
Impact deforming_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options);

} // namespace abut
