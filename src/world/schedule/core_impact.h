#pragma once

#include "world/schedule/body_impact.h"

namespace abut {

/// Finds the first time at which two bodies meet that share no point at the start, each a model, ball,
/// capsule, box or convex body: by the surfaces of their cores.
///
/// In          tolerance: length; at the returned time the bodies are at most this far apart.
/// Accuracy    as `time_of_impact`. Bodies that slide along each other are followed triangle by
///             triangle, so a distance that stays short does not end the search.
Impact core_impact(const MovingBody& a, const MovingBody& b, double tolerance,
                   const ImpactOptions& options);

} // namespace abut
