#pragma once

#include "rigid/motion/moving_pair.h"

#include <algorithm>
#include <cstdint>

namespace abut {

/// A moment and a span of time after it. Nothing meets before `begin`, and meetings after `end` do
/// not matter. Shares are fractions of the time from the moment to the end.
struct TimeSpan {
    const Moment& moment;
    double begin, end;

    /// The time of a share, rounded down.
    [[nodiscard]] double at(float share) const {
        return std::max(begin, moment.time + (1 - 0x1p-40) * share * (end - moment.time));
    }
};

/// A node and the children that are asked for: bit i for child i.
struct NodeChildren {
    const Node& node;
    std::uint32_t lanes;
};

/// Pairs of children of nodes a and b that may meet in a span of time.
struct MeetingChildren {
    std::uint64_t pairs = 0;                 ///< bit 8 i + j: child i of a's node, j of b's
    float share[Node::kWidth][Node::kWidth]; ///< the pair does not meet before this share
};

/// Pairs of triangles of leaves a and b that may meet in a span of time.
struct MeetingTriangles {
    std::uint32_t pairs = 0; ///< bit 4 i + j: triangle i of a and j of b
    float share[TriangleLeaf::kLanes][TriangleLeaf::kLanes];
};

/// Finds the pairs of children of two nodes that may meet.
///
/// Accuracy    conservative, whatever is rounded: pairs without a bit do not meet in the span, the
///             others not before their shares.
/// Cost        some 150 operations for eight pairs of children, and some 600 for a pair of nodes.
/// Source      moving boxes [Ericson 2005, 5.5.8], along the face axes of both boxes [Gottschalk,
///             Lin, Manocha 1996]. Differs: rotation widens the boxes, at a bounded speed.
void find_meeting(const TimeSpan& span, const NodeChildren& a, const NodeChildren& b,
                  MeetingChildren& result);

/// Finds the pairs of triangles of two leaves that may meet. The leaves are children of the given
/// nodes. Compares along the axes of a's node and along the triangles' normals.
void find_meeting(const TimeSpan& span, const Node& node_a, const TriangleLeaf& a,
                  const Node& node_b, const TriangleLeaf& b, MeetingTriangles& result);

} // namespace abut
