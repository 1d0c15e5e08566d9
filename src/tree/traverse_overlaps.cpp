#include "tree/traverse_overlaps.h"

#include "core/set_bits.h"
#include "core/stop.h"

#include <boost/container/small_vector.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_overlaps.cpp"
#include "simd/foreach_target.h"
#include "tree/overlap_opener-inl.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_TRAVERSE_OVERLAPS_ONCE
#define ABUT_TREE_TRAVERSE_OVERLAPS_ONCE
namespace abut::traverse_overlaps_detail {

using PairStack = boost::container::small_vector<OverlapTraversal::Pair, 512>;

} // namespace abut::traverse_overlaps_detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace traverse_overlaps_detail; // NOLINT(google-build-using-namespace): its own

/// A bit for each child of a node whose box may come within the margin of the given box, at any time
/// or at one end of the motion.
HWY_INLINE std::uint32_t near_children(const MovingNode& node, const MovingBoxRef& box,
                                       float margin, std::optional<StepEnd> at) {
    const MovingBoxLanes::D d;
    const auto minus_margin = hn::Set(d, -margin);
    std::uint32_t bits = 0;
    for (std::size_t first = 0; first < MovingNode::kWidth; first += hn::Lanes(d))
        bits |= (at ? StandingBoxLanes(node.boxes(), first, *at).overlap_bits(box, minus_margin)
                    : MovingBoxLanes(node.boxes(), first).overlap_bits(box, minus_margin))
                << first;
    return bits;
}

/// Pairs of children whose boxes may come within the margin of each other.
class PendingOverlaps {
public:
    PendingOverlaps(const OverlapTraversal& traversal, PairStack& pairs)
        : margin_(traversal.margin), at_(traversal.at), pairs_(pairs) {}

    void add_self(std::uint32_t name) { pairs_.push_back({name, name}); }
    template <typename PairOf>
    void add_near(const MovingNode& node, const MovingBoxRef& box, std::uint32_t wanted,
                  const PairOf& pair_of) {
        for (const std::uint32_t lane : SetBits(near_children(node, box, margin_, at_) & wanted))
            pairs_.push_back(pair_of(lane));
    }

private:
    float margin_;
    std::optional<StepEnd> at_;
    PairStack& pairs_;
};

bool traverse_overlaps(const OverlapTraversal& traversal, OverlapTraversal::Pair start,
                       OverlapVisitor& visitor) {
    if (traversal.a.empty() || traversal.b.empty())
        return true;
    PairStack pairs{start};
    PendingOverlaps pending(traversal, pairs);
    OverlapOpener opener(traversal, pending);
    SearchSteps steps;
    while (!pairs.empty()) {
        steps.take();
        const OverlapTraversal::Pair pair = pairs.back();
        pairs.pop_back();
        const NodeRef a = traversal.a.named(pair.a), b = traversal.b.named(pair.b);
        if (!(a.is_leaf() && b.is_leaf()))
            opener.open(pair, a, b);
        else if (!visitor.visit(leaf_number(a), leaf_number(b)))
            return false;
    }
    return true;
}

/// Opens the pairs level by level, until there are `wanted` pairs or only pairs of leaves.
void split_overlaps(const OverlapTraversal& traversal, std::size_t wanted, PairStack& pairs) {
    for (bool opened = true; opened && pairs.size() < wanted;) {
        opened = false;
        PairStack next;
        PendingOverlaps pending(traversal, next);
        OverlapOpener opener(traversal, pending);
        for (const OverlapTraversal::Pair& pair : pairs) {
            const NodeRef a = traversal.a.named(pair.a), b = traversal.b.named(pair.b);
            if (a.is_leaf() && b.is_leaf()) {
                next.push_back(pair);
                continue;
            }
            opener.open(pair, a, b);
            opened = true;
        }
        pairs = std::move(next);
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(traverse_overlaps);
HWY_EXPORT(split_overlaps);

bool traverse_overlaps(const OverlapTraversal& traversal, OverlapTraversal::Pair start,
                       OverlapVisitor& visitor) {
    return HWY_DYNAMIC_DISPATCH(traverse_overlaps)(traversal, start, visitor);
}

std::vector<OverlapTraversal::Pair> split_overlaps(const OverlapTraversal& traversal,
                                                   std::size_t wanted) {
    traverse_overlaps_detail::PairStack pairs;
    if (!traversal.a.empty() && !traversal.b.empty()) {
        pairs.push_back({});
        HWY_DYNAMIC_DISPATCH(split_overlaps)(traversal, wanted, pairs);
    }
    return {pairs.begin(), pairs.end()};
}

} // namespace abut
#endif
