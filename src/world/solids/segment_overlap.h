#pragma once

#include "world/solids/contact_candidate.h"

#include <array>

namespace abut {

/// The axis of a capsule in a contact frame, and its radius.
struct FlatSegment {
    std::array<FlatCorner, 2> ends;
    double radius = 0;
};

/// Adds the ends of the part in which two capsules lie side by side, with their names. None if both
/// radii are 0, or if no end lies beside the other axis.
void add_segment_overlap(const FlatSegment& a, const FlatSegment& b, ContactCandidates& candidates);

} // namespace abut
