#pragma once

#include "world/curved/curved_patch.h"
#include "world/curved/curved_side.h"
#include "world/solids/contact_candidate.h"

#include <cstdint>
#include <optional>

namespace abut {

/// A part of an edge, by parameters from 0 to 1, and the edges of the polygon at its ends.
struct EdgePart {
    double begin = 0, end = 1;
    std::optional<std::uint32_t> begin_edge, end_edge;
};

/// The part of an edge that lies under a disc or a line of a solid, seen along the frame's normal; of a line, the
/// place where they cross, if they do so by more than half a degree. None of a point.
std::optional<EdgePart> part_under(const NearEdge& edge, const CurvedSide& side,
                                   const ContactFrame& frame);

} // namespace abut
