#pragma once

#include "core/stop.h"
#include "geometry/triangle_leaf.h"
#include "tree/pair_frame.h"
#include "tree/tree.h"

#include <cstdint>
#include <limits>

namespace abut {

/// What a traversal of two trees does where two leaves may be near each other.
class LeafPairVisitor {
public:
    LeafPairVisitor() = default;
    LeafPairVisitor(const LeafPairVisitor&) = delete;
    LeafPairVisitor& operator=(const LeafPairVisitor&) = delete;
    virtual ~LeafPairVisitor() = default;

    /// Looks at the pairs of triangles that are left: not none. Returns the squared world distance
    /// beyond which pairs do not matter from now on; negative: stop.
    virtual double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) = 0;
    /// A direction of the world, from a to b, along which the trees seem to be far apart: that of
    /// the closest points so far. Any vector of length 1 at most does; zero if none is known.
    [[nodiscard]] virtual Vec3 direction() const { return {}; }
};

enum class Verdict : std::uint8_t {
    done,     ///< everything within the bound was visited
    stopped,  ///< by the visitor
    accepted, ///< some boxes lie wholly within the bound of each other
    out_of_steps,
};

struct PairTraversal {
    const Tree& a;
    const Tree& b;
    const PairFrame& frame;
    double bound_sq = 0; ///< squared world distance beyond which pairs do not matter; 0: overlap
    /// Pairs of boxes that traverse_nearest keeps, at most about: beyond, it goes depth first.
    std::size_t queue_limit = std::size_t{1} << 16;
    std::uint64_t volume_tests = 0;    ///< counted up
    std::uint64_t primitive_tests = 0; ///< counted up
    SearchSteps steps{};               ///< one a pair of boxes
    /// If traverse_nearest ran out of steps: a lower bound of the squared world distance of all pairs
    /// that it has not visited.
    double left_sq = std::numeric_limits<double>::infinity();

    /// Notes a pair that is left, by the lower bound of its squared distance.
    void leave(float least_sq) {
        if (!(least_sq >= left_sq)) // also of what is not a number
            left_sq = least_sq >= 0 ? least_sq : 0;
    }
};

/// Visits the leaf pairs that may share a point, depth first. Needs no bound.
///
/// In          trees of triangles; frame.valid.
/// Accuracy    conservative: every pair of triangles that share a point is visited.
/// Cost        8 box pairs in one SIMD pass, some 50 instructions, and some 350 for each pair of
///             nodes; no allocation for trees of usual depth.
/// Source      [Gottschalk, Lin, Manocha 1996]. Differs: the six face axes only, one box against
///             eight; both nodes are opened at once where they are of like size.
Verdict traverse_contacts(PairTraversal& traversal, LeafPairVisitor& visitor);

/// The same for the leaf pairs that may be within the bound, which stays; `accepted` where two boxes
/// lie wholly within it.
Verdict traverse_within(PairTraversal& traversal, LeafPairVisitor& visitor);

/// The same, nearest boxes first: fewest visits where the bound shrinks.
/// Source      [Larsen, Gottschalk, Lin, Manocha 1999], the priority queue. Differs: buckets, so
///             nearest to within 12 %; boxes and triangles are also told apart by their
///             gap along the direction of the closest points so far.
Verdict traverse_nearest(PairTraversal& traversal, LeafPairVisitor& visitor);

} // namespace abut
