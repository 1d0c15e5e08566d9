#pragma once

#include <abut/maintenance_path.h>

#include <vector>

namespace abut {

/// Finds the least distance of a moving probe from the parts of a walk.
///
/// In          motions: one after the other. ignored: sorted. Distances change no faster than the
///             points of the probe move; `speeds` bounds that for each motion.
/// Source      minimisation of a Lipschitz function by its cones [Piyavskii 1972; Shubert 1972].
PathClearance least_clearance(Walk& walk, const Probe& probe, const std::vector<Motion>& motions,
                              const std::vector<double>& speeds,
                              const std::vector<WalkPart>& ignored, const PathOptions& options);

} // namespace abut
