#pragma once

#include "core/stop.h"
#include "geometry/leaf/triangle_leaf.h"
#include "tree/obb_tree.h"
#include "tree/pair_frame.h"

#include <cstdint>
#include <limits>

namespace abut {

/// Called for each pair of leaves that may be near each other.
class LeafPairVisitor {
public:
    LeafPairVisitor() = default;
    LeafPairVisitor(const LeafPairVisitor&) = delete;
    LeafPairVisitor& operator=(const LeafPairVisitor&) = delete;
    virtual ~LeafPairVisitor() = default;

    /// Tests the pairs of triangles that were not culled; there is at least one. Returns the
    /// squared world distance beyond which pairs no longer matter, or kStopTraversal.
    virtual double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) = 0;
    /// A world direction, from a to b, along which the trees seem to be far apart: the direction
    /// between the closest points found so far. Any vector of length at most 1 is correct. Zero if
    /// none is known.
    [[nodiscard]] virtual Vec3 direction() const { return {}; }
};

enum class Verdict : std::uint8_t {
    done,     ///< everything within the bound was visited
    stopped,  ///< the visitor stopped it
    accepted, ///< all points of some two boxes are within the bound of each other
    out_of_steps,
};

struct PairTraversal {
    const Tree& a;
    const Tree& b;
    const PairFrame& frame;
    double bound_sq = 0; ///< squared world distance beyond which pairs do not matter; 0: only
                         ///< overlaps do
    /// traverse_nearest queues at most about this many pairs of boxes. Beyond that it goes depth
    /// first.
    std::size_t queue_limit = std::size_t{1} << 16;
    std::uint64_t volume_tests = 0;    ///< incremented
    std::uint64_t primitive_tests = 0; ///< incremented
    SearchSteps steps{};               ///< one per pair of boxes
    /// If traverse_nearest ran out of steps: a lower bound of the squared world distance of all pairs
    /// that it has not visited.
    double left_sq = std::numeric_limits<double>::infinity();

    /// Records that a pair is not visited, by the lower bound of its squared distance. NaN counts as 0.
    void leave(float least_sq) {
        if (!(least_sq >= left_sq))
            left_sq = least_sq >= 0 ? least_sq : 0;
    }
};

/// Visits the leaf pairs that may share a point, depth first. Needs no bound.
///
/// In          trees of triangles; frame.valid.
/// Accuracy    conservative: every pair of triangles that share a point is visited.
/// Cost        about 50 instructions for 8 box pairs in one SIMD pass, and about 350 for each pair
///             of nodes; no allocation for trees of usual depth.
/// Source      [Gottschalk, Lin, Manocha 1996]. Differs: tests only the six face axes, one box
///             against eight; opens both nodes at once if they are of similar size.
Verdict traverse_contacts(PairTraversal& traversal, LeafPairVisitor& visitor);

/// Visits the leaf pairs that may be within the bound, depth first. The bound stays as it is.
/// Returns `accepted` as soon as all points of two boxes are within the bound of each other.
Verdict traverse_within(PairTraversal& traversal, LeafPairVisitor& visitor);

/// Visits the leaf pairs that may be within the bound, the nearest boxes first. If the visitor
/// shrinks the bound, this order needs the fewest visits.
/// Source      [Larsen, Gottschalk, Lin, Manocha 1999], the priority queue. Differs: keys are
///             sorted into buckets, so the order is by distance to within 12 %; boxes and triangles
///             are also separated by their gap along the direction of the closest points so far.
Verdict traverse_nearest(PairTraversal& traversal, LeafPairVisitor& visitor);

} // namespace abut
