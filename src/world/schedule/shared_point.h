#pragma once

#include <abut/world.h>

#include "world/narrow_phase/narrow_phase.h"

namespace abut {

/// A point that two bodies share, to rounding. They share a point, and none of them is a deformable.
///
/// In          gap: that of the bodies, as gap_between returns it without depths.
Vec3 shared_point(const PlacedBody& a, const PlacedBody& b, const BodyGap& gap);

} // namespace abut
