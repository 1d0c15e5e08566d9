#pragma once

#include "rigid/motion/moving_pair.h"

#include <algorithm>
#include <cstdint>

namespace abut {

/// A moment, and the span of time after it that is looked at: nothing meets before `begin`, and what
/// can only meet after `end` does not matter. Shares are of the time from the moment to the end.
struct TimeSpan {
    const Moment& moment;
    double begin, end;

    /// The time of a share: not later than it is in real arithmetic.
    [[nodiscard]] double at(float share) const {
        return std::max(begin, moment.time + (1 - 0x1p-40) * share * (end - moment.time));
    }
};

/// A node, and those of its children that are asked for: bit i for child i.
struct NodeChildren {
    const Node& node;
    std::uint32_t lanes;
};

/// Pairs of children of two nodes, a's and b's, that may meet in a span of time.
struct MeetingChildren {
    std::uint64_t pairs = 0;                 ///< bit 8 i + j: child i of a's node, j of b's
    float share[Node::kWidth][Node::kWidth]; ///< of the time: they do not meet before
};

/// Pairs of triangles of two leaves that may meet in a span of time.
struct MeetingTriangles {
    std::uint32_t pairs = 0; ///< bit 4 i + j: triangle i of a and j of b
    float share[TriangleLeaf::kLanes][TriangleLeaf::kLanes];
};

/// Accuracy    conservative, whatever is rounded: what is below pairs without a bit does not meet in
///             the span, what is below others not before their shares.
/// Cost        some 150 operations for eight pairs of children, and some 600 for a pair of nodes.
/// Source      moving boxes [Ericson 2005, 5.5.8], along the face axes of both [Gottschalk, Lin,
///             Manocha 1996]. Differs: rotation widens the boxes, at a bounded speed.
void find_meeting(const TimeSpan& span, const NodeChildren& a, const NodeChildren& b,
                  MeetingChildren& result);

/// The same for the triangles of two leaves, children of the nodes: along the axes of a's node and
/// along their normals.
void find_meeting(const TimeSpan& span, const Node& node_a, const TriangleLeaf& a,
                  const Node& node_b, const TriangleLeaf& b, MeetingTriangles& result);

} // namespace abut
