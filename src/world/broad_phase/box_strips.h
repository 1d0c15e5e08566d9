#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Number of boxes in a strip. A search then needs about 10 MB at a time.
inline constexpr std::size_t kBoxesOfStrip = std::size_t{1} << 16;

/// Finds the same pairs as overlapping_boxes, for bounds that are numbers. It needs memory only for
/// one strip and for the pairs. Strips are ranges of the boxes' lower bounds along one axis. Each
/// strip is searched together with the boxes that reach into it from earlier strips.
///
/// In          strip: number of boxes in a strip, at least 1.
/// Cost        O(n log n + pairs) if few boxes extend through many strips.
std::vector<IndexPair> overlaps_by_strips(std::span<const Box3> boxes, double gap,
                                          const PairFilter& filter,
                                          std::size_t strip = kBoxesOfStrip);

} // namespace abut
