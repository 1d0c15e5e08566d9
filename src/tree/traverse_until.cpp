#include "tree/traverse_until.h"

#include "core/set_bits.h"
#include "core/stop.h"

#include <boost/container/small_vector.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_until.cpp"
#include "simd/foreach_target.h"
#include "tree/overlap_opener-inl.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_TRAVERSE_UNTIL_ONCE
#define ABUT_TREE_TRAVERSE_UNTIL_ONCE
namespace abut::traverse_until_detail {

using TimedStack = boost::container::small_vector<TimedPair, 512>;

/// A list of later pairs does not grow beyond this, which bounds its memory.
constexpr std::size_t kMostLater = 4096;

} // namespace abut::traverse_until_detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace traverse_until_detail; // NOLINT(google-build-using-namespace): its own

/// Pairs of children with the times at which they may first overlap.
class PendingUntil {
public:
    PendingUntil(float margin, const UntilVisitor& visitor, TimedStack& pairs,
                 std::vector<TimedPair>* later)
        : margin_(margin), visitor_(visitor), pairs_(pairs), later_(later) {}

    void add_self(std::uint32_t name) { pairs_.push_back({{name, name}, 0}); }
    template <typename PairOf>
    void add_near(const MovingNode& node, const MovingBoxRef& box, std::uint32_t wanted,
                  const PairOf& pair_of) {
        const UntilLanes part(visitor_.until(), margin_);
        constexpr auto kLanes = static_cast<std::uint32_t>(hn::MaxLanes(MovingBoxLanes::D()));
        for (std::uint32_t i = 0; i < MovingNode::kWidth; i += kLanes) {
            const MovingBoxLanes lanes(node.boxes(), i);
            const MovingBoxLanes::UntilBits near = lanes.overlaps_until(box, part);
            const std::uint32_t now = near.until & near.start & wanted >> i,
                                soon = near.until & ~near.start & wanted >> i;
            for (const std::uint32_t lane : SetBits(now))
                pairs_.push_back({pair_of(i + lane), 0});
            if (soon != 0)
                add_later(lanes, box, soon, [&](std::uint32_t lane) { return pair_of(i + lane); });
        }
    }

private:
    /// Adds pair_of(lane) for the lanes of `soon`, which do not overlap at the start.
    template <typename PairOf>
    void add_later(const MovingBoxLanes& lanes, const MovingBoxRef& box, std::uint32_t soon,
                   const PairOf& pair_of) {
        const MovingBoxLanes::D d;
        alignas(32) float first[MovingNode::kWidth];
        hn::StoreU(lanes.first_overlaps(box, hn::Set(d, -margin_)), d, first);
        for (const std::uint32_t lane : SetBits(soon))
            if (later_ != nullptr && later_->size() < kMostLater)
                later_->push_back({pair_of(lane), first[lane]});
            else
                pairs_.push_back({pair_of(lane), first[lane]});
    }

    float margin_;
    const UntilVisitor& visitor_;
    TimedStack& pairs_;
    std::vector<TimedPair>* later_;
};

bool traverse_until(const OverlapTraversal& traversal, const TimedPair& start,
                    UntilVisitor& visitor, std::vector<TimedPair>* later) {
    if (traversal.a.empty() || traversal.b.empty())
        return true;
    TimedStack pairs{start};
    PendingUntil pending(traversal.margin, visitor, pairs, later);
    OverlapOpener opener(traversal, pending);
    SearchSteps steps;
    while (!pairs.empty()) {
        steps.take();
        const TimedPair timed = pairs.back();
        pairs.pop_back();
        if (timed.first > visitor.until())
            continue;
        const NodeRef a = traversal.a.named(timed.pair.a), b = traversal.b.named(timed.pair.b);
        if (!(a.is_leaf() && b.is_leaf()))
            opener.open(timed.pair, a, b);
        else if (!visitor.visit(leaf_number(a), leaf_number(b)))
            return false;
    }
    return true;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(traverse_until);

bool traverse_until(const OverlapTraversal& traversal, const TimedPair& start,
                    UntilVisitor& visitor, std::vector<TimedPair>* later) {
    return HWY_DYNAMIC_DISPATCH(traverse_until)(traversal, start, visitor, later);
}

} // namespace abut
#endif
