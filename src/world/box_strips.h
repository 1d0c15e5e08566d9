#pragma once

#include <abut/broad_phase.h>

#include "world/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Boxes that meet are searched in strips of so many: some 10 MB at a time.
inline constexpr std::size_t kBoxesOfStrip = std::size_t{1} << 16;

/// As overlapping_boxes, for bounds that are numbers, in memory for one strip and the pairs: the boxes
/// are cut into strips by their lower bounds along one axis, and each strip is searched with what reaches into
/// it from those before.
///
/// In          strip: boxes of one, at least 1.
/// Cost        O(n log n + pairs) where few boxes reach through many strips.
std::vector<IndexPair> overlaps_by_strips(std::span<const Box3> boxes, double gap,
                                          const PairFilter& wanted,
                                          std::size_t strip = kBoxesOfStrip);

} // namespace abut
