#pragma once

#include "ccd_step_rows.h"

#include <cstddef>
#include <optional>

namespace abut::bench {

/// Pairs of triangles of one mesh whose swept boxes overlap: Embree builds its tree and collides it
/// with itself, on one thread. Less than half of continuous collision detection: no elementary test
/// is made. Nothing where built without Embree.
std::optional<std::size_t> embree_swept_pairs(const CcdStep& step);

} // namespace abut::bench
