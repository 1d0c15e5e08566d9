#pragma once

#include <abut/motion.h>

#include "rigid/motion/trajectory.h"

namespace abut {

/// A model and its motion, whose start may be any transform.
struct MovingModel {
    Model model;
    Trajectory trajectory;
};

/// Finds the first time, up to `until`, at which two models are at most `radius` apart.
///
/// In/out      radius 0: they share a point. Otherwise triangle pairs are compared in double
///             precision, and `gap` is the distance less the radius. The points of the result are
///             on the surfaces. If nothing meets by `until`, `time` is 1.
/// Degenerate  a start that scales unevenly or shears is first applied to a copy of the model.
/// Accuracy, Errors, Source as `time_of_impact`.
Impact first_impact(const MovingModel& a, const MovingModel& b, double radius, double until,
                    const ImpactOptions& options);

} // namespace abut
