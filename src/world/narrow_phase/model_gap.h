#pragma once

#include <abut/model.h>
#include <abut/world.h>

#include "world/narrow_phase/narrow_phase.h"

namespace abut {

/// The gap of the surfaces of two models. The ids are not set.
///
/// In          upper_bound: as gap_between. depths: `yes` for models that share a point.
/// Accuracy    as `distance` of models. A depth is a bound. Where the surfaces touch, or are apart by
///             no more than rounding, the normal is across the faces and edges there.
BodyGap model_gap(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, double upper_bound, Depths depths,
                  WarmStart& warm_start);

/// A distance above this share of the coordinates is not rounding.
inline constexpr double kClearOfFaces = 0x1p-40;

/// Sets the gap of a surface and a solid that touch. If the surface lies inside, clear of the solid's
/// faces, these tell no direction.
inline void set_touching(BodyGap& gap, double clear) {
    if (gap.distance > clear)
        gap.normal = {};
    gap.distance = 0;
}

} // namespace abut
