#pragma once

#include "tree/pair_frame.h"
#include "tree/tree.h"

#include <cstdint>

namespace abut {

/// What a traversal of two trees does where two leaves may be near each other.
class LeafPairVisitor {
public:
    LeafPairVisitor() = default;
    LeafPairVisitor(const LeafPairVisitor&) = delete;
    LeafPairVisitor& operator=(const LeafPairVisitor&) = delete;
    virtual ~LeafPairVisitor() = default;

    /// Returns the squared world distance beyond which pairs do not matter from now on; negative:
    /// stop.
    virtual double visit(NodeRef leaf_a, NodeRef leaf_b) = 0;
};

enum class Verdict : std::uint8_t {
    done,     ///< everything within the bound was visited
    stopped,  ///< by the visitor
    accepted, ///< some boxes lie wholly within the bound of each other (only if that was asked for)
};

struct PairTraversal {
    const Tree& a;
    const Tree& b;
    const PairFrame& frame;
    double bound_sq = 0; ///< squared world distance beyond which pairs do not matter; 0: overlap
    bool accept_early = false;      ///< stop where two boxes cannot be farther apart than the bound
    std::uint64_t volume_tests = 0; ///< counted up
};

/// Visits the leaf pairs that may be within the bound, depth first.
///
/// In          frame.valid.
/// Accuracy    conservative: every pair of primitives within the bound is visited.
/// Cost        8 box pairs in one SIMD pass, some 60 instructions; no allocation for trees of usual
///             depth.
/// Source      [Gottschalk, Lin, Manocha 1996]. Differs: boxes aligned to each tree's own frame,
///             the six face axes only, one box against eight; the box of larger surface is opened.
Verdict traverse_depth_first(PairTraversal& traversal, LeafPairVisitor& visitor);

/// The same, nearest boxes first: fewest visits where the bound shrinks.
/// Source      [Larsen, Gottschalk, Lin, Manocha 1999], the priority queue. Differs: buckets, so
///             nearest to within 12 %; unbounded.
Verdict traverse_best_first(PairTraversal& traversal, LeafPairVisitor& visitor);

} // namespace abut
