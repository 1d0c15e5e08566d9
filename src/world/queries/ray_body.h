#pragma once

#include <abut/shapes.h>
#include <abut/world.h>

#include "world/narrow_phase/narrow_phase.h"

namespace abut {

/// Where a ray first meets a body. The id is not set.
///
/// In          a direction that is not zero.
/// Accuracy    surfaces: exact as to whether they meet. Solids: to rounding.
BodyRayHit ray_body_hit(const PlacedBody& body, const Ray& ray, const Progress& progress);

} // namespace abut
