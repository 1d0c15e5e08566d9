#pragma once

#include <abut/elementary_impact.h>

#include "ccd/elementary_batch.h"

#include <cstdint>

namespace abut {

/// What is known of the pairs of a batch. A lane with neither bit is undecided.
struct CrossingBatch {
    std::uint32_t apart = 0; ///< the lane's pair shares no point at any time in [0, 1]
    std::uint32_t meet = 0;  ///< the lane's pair shares a point; the members below hold for it
    /// Not later than the first impact, and less than 1e-9 before it.
    double time[ElementaryBatch::kLanes];
    /// Position of the origin in the patch (see difference_patch.h).
    double x[ElementaryBatch::kLanes], y[ElementaryBatch::kLanes];
    double normal[3][ElementaryBatch::kLanes]; ///< normal of the patch, of any length and sign
};

/// Decides pairs whose four vertices become coplanar once. Most pairs that the filter leaves do so.
/// The root of the coplanarity cubic is enclosed in an interval outside which the cubic's sign is
/// certain. Whether the patch holds the origin during that interval is decided with bounds on all
/// rounding.
///
/// In          finite coordinates of any size; the kind of all lanes.
/// Accuracy    certified, with or without fused operations.
/// Cost        some 15 to 25 ns a pair (AVX-512, a full batch).
/// Source      see docs/elementary-tests.md.
void decide_crossings(const ElementaryBatch& batch, ElementaryKind kind, CrossingBatch& result);

/// Decides one pair, with the same answer, in lane 0.
void decide_crossing(const ElementaryPair& pair, CrossingBatch& result);

/// decide_crossings with one lane at a time: the reference for every SIMD target.
void decide_crossings_reference(const ElementaryBatch& batch, ElementaryKind kind,
                                CrossingBatch& result);

} // namespace abut
