#pragma once

#include "world/narrow_phase/world_data.h"
#include "world/schedule/closing_time.h"

namespace abut {

/// A time before which two bodies do not meet whose motions are known exactly, up to the time `most`:
/// that of their first contact, or a time in which they turn by no more than about half a turn.
///
/// In          motion.prescribed; rigid bodies.
/// Accuracy    as `body_impact`: never later than the first contact, and near it.
double prescribed_free_time(const Body& a, const Body& b, const RelativeMotion& motion,
                            double most);

} // namespace abut
