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

} // namespace abut
