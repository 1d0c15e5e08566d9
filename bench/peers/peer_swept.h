#pragma once

#include "suites/ccd_step_rows.h"

#include <cstddef>
#include <optional>

namespace abut::bench {

/// The number of triangle pairs of one mesh whose swept boxes overlap. Embree builds its tree and
/// collides it with itself, on one thread. This is less than half of continuous collision
/// detection: no elementary tests are made. Nothing if built without Embree.
std::optional<std::size_t> embree_swept_pairs(const CcdStep& step);

} // namespace abut::bench
