#pragma once

#include <abut/elementary_impact.h>

#include "geometry/elementary_block.h"

#include <cstdint>

namespace abut {

/// What is known of the pairs in the lanes of a block; lanes with neither bit are undecided.
struct CrossingBlock {
    std::uint32_t apart = 0; ///< share no point at any time in [0, 1]
    std::uint32_t meet = 0;  ///< share a point; for these:
    /// Not later than the first impact, and less than 1e-9 before it.
    double time[ElementaryBlock::kLanes];
    /// Of the origin in the patch (see difference_patch.h).
    double x[ElementaryBlock::kLanes], y[ElementaryBlock::kLanes];
    double normal[3][ElementaryBlock::kLanes]; ///< of the patch, of any length and side
};

/// Decides pairs whose vertices pass through one plane once, which most pairs do that the filter
/// leaves: the root of the coplanarity cubic is enclosed in an interval, outside which the cubic
/// has certain signs; where the patch holds the origin during it is decided with bounds of all
/// rounding.
///
/// In          finite coordinates of any size; the kind of all lanes.
/// Accuracy    certified, with or without fused operations.
/// Cost        some 15 to 25 ns a pair (AVX-512, a full block).
/// Source      see docs/elementary-tests.md.
void decide_crossings(const ElementaryBlock& block, ElementaryKind kind, CrossingBlock& result);

/// The same of one pair, with the same answer, in lane 0.
void decide_crossing(const ElementaryPair& pair, CrossingBlock& result);

/// The same as for a block with one lane at a time: the reference for every SIMD target.
void decide_crossings_reference(const ElementaryBlock& block, ElementaryKind kind,
                                CrossingBlock& result);

} // namespace abut
