#pragma once

#include "world/body_impact.h"

namespace abut {

/// When two bodies first meet of which one, or both, are deformable surfaces in the step that they have.
///
/// Accuracy    never later than the first contact, and none is missed. Two deformables: exact, as
///             `first_impact`.
/// Source      two deformables: docs/representative-triangles.md. Else boxes in motion, halved in space
///             and time [Snyder et al. 1993], and conservative advancement of two triangles [Mirtich
///             1996], along the direction in which they are apart.
Impact deforming_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options);

} // namespace abut
