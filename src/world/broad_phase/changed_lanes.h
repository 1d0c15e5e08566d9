#pragma once

#include "world/broad_phase/box_levels.h"

#include <cstddef>
#include <vector>

namespace abut {

/// Finds the boxes of a tree that a box may begin or cease to overlap when it moves from `before`
/// to `now`: the boxes that overlap one of both in single precision, and those where bounds are
/// equal in single precision. Appends their lanes of level 0 to `lanes`. The moving box may be
/// among them.
///
/// Cost        tests the nodes that overlap `before` or `now`; returns how many of level 0 these
///             were. The boxes that overlap both are not listed, so that the list is short.
std::size_t find_changed_lanes(const BoxLevels& levels, const Aabb& before, const Aabb& now,
                               std::vector<std::size_t>& lanes);

} // namespace abut
