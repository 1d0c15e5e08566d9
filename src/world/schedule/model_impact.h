#pragma once

#include "world/schedule/body_impact.h"

namespace abut {

/// Finds the first time at which the surface of a model and a ball, capsule, box or convex body meet
/// that share no point at the start.
///
/// In          tolerance: length; at the returned time the bodies are at most this far apart.
/// Accuracy    as `time_of_impact`. Bodies that slide along each other are followed triangle by
///             triangle, so a distance that stays short does not end the search.
Impact model_impact(const MovingBody& model, const MovingBody& solid, double tolerance,
                    const ImpactOptions& options);

} // namespace abut
