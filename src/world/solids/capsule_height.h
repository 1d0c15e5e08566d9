#pragma once

#include "math/vector.h"

#include <optional>

namespace abut {

/// The height at which a vertical line leaves a capsule, times `sign`: at its top if the sign is 1,
/// at its bottom if it is -1. None if the line misses the capsule.
///
/// In          p, q: ends of the axis; z is the height. The line is at x, y.
std::optional<double> capsule_height(const Vec3& p, const Vec3& q, double radius, double x,
                                     double y, double sign);

} // namespace abut
