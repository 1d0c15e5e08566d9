#include "tree/traverse_overlaps.h"

#include "core/set_bits.h"
#include "core/stop.h"

#include <boost/container/small_vector.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_overlaps.cpp"
#include "simd/foreach_target.h"
#include "volume/moving_box-inl.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_TRAVERSE_OVERLAPS_ONCE
#define ABUT_TREE_TRAVERSE_OVERLAPS_ONCE
namespace abut::traverse_overlaps_detail {

using PairStack = boost::container::small_vector<OverlapTraversal::Pair, 512>;

/// The box of a child. In: not the root's name.
inline MovingBoxRef box_of(const MovingTree& tree, std::uint32_t name) {
    return {tree.nodes[node_of(name)].boxes(), lane_of(name)};
}

} // namespace abut::traverse_overlaps_detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace traverse_overlaps_detail; // NOLINT(google-build-using-namespace): its own

/// A bit for each child of a node whose box may come within the margin of the given box.
HWY_INLINE std::uint32_t near_children(const MovingNode& node, const MovingBoxRef& box,
                                       float margin) {
    const MovingBoxLanes::D d;
    const auto minus_margin = hn::Set(d, -margin);
    std::uint32_t bits = 0;
    for (std::size_t first = 0; first < MovingNode::kWidth; first += hn::Lanes(d))
        bits |= MovingBoxLanes(node.boxes(), first).overlap_bits(box, minus_margin) << first;
    return bits;
}

/// Replaces a pair that is not two leaves by pairs of children that may overlap.
class Opener {
public:
    Opener(const OverlapTraversal& traversal, PairStack& pairs)
        : traversal_(traversal), pairs_(pairs) {}

    void open(OverlapTraversal::Pair pair, NodeRef a, NodeRef b) {
        if (traversal_.is_self() && pair.a == pair.b)
            open_self(a.index());
        else if (a.is_leaf())
            open_b(pair.a, b.index(), 0xffU);
        else if (b.is_leaf())
            open_a(a.index(), pair.b);
        else
            for_each_child(traversal_.a, a.index(), [&](std::uint32_t name, std::uint32_t) {
                open_b(name, b.index(), 0xffU);
            });
    }

private:
    /// Calls visit(name, lane) for each child of a node.
    template <typename Visit>
    static void for_each_child(const MovingTree& tree, std::uint32_t node, const Visit& visit) {
        for (std::uint32_t i = 0; i < MovingNode::kWidth && !tree.nodes[node].child[i].is_none();
             ++i)
            visit(child_name(node, i), i);
    }

    void open_self(std::uint32_t node) {
        if (!traversal_.skipped.empty() && traversal_.skipped[node] != 0)
            return;
        for_each_child(traversal_.a, node, [&](std::uint32_t name, std::uint32_t lane) {
            pairs_.push_back({name, name});
            open_b(name, node, 0xfeU << lane);
        });
    }
    /// Pairs a child of a with those children of a node of b that are `wanted`.
    void open_b(std::uint32_t name, std::uint32_t node, std::uint32_t wanted) {
        const std::uint32_t near =
            near_children(traversal_.b.nodes[node], box_of(traversal_.a, name), traversal_.margin);
        for (const std::uint32_t lane : SetBits(near & wanted))
            pairs_.push_back({name, child_name(node, lane)});
    }
    void open_a(std::uint32_t node, std::uint32_t name) {
        const std::uint32_t near =
            near_children(traversal_.a.nodes[node], box_of(traversal_.b, name), traversal_.margin);
        for (const std::uint32_t lane : SetBits(near))
            pairs_.push_back({child_name(node, lane), name});
    }

    const OverlapTraversal& traversal_;
    PairStack& pairs_;
};

bool traverse_overlaps(const OverlapTraversal& traversal, OverlapTraversal::Pair start,
                       OverlapVisitor& visitor) {
    if (traversal.a.empty() || traversal.b.empty())
        return true;
    PairStack pending{start};
    Opener opener(traversal, pending);
    SearchSteps steps;
    while (!pending.empty()) {
        steps.take();
        const OverlapTraversal::Pair pair = pending.back();
        pending.pop_back();
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
        Opener opener(traversal, next);
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
