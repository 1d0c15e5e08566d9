#include "tree/traverse_pair.h"

#include "tree/near_first_queue.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_pair.cpp"
#include "simd/foreach_target.h"
#include "simd/simd.h"

// What the targets share. Two boxes still to be looked at: a child is named by 8 * node + lane, the
// root by kRoot.
#ifndef ABUT_TREE_TRAVERSE_PAIR_ONCE
#define ABUT_TREE_TRAVERSE_PAIR_ONCE
namespace abut::traverse_pair {

constexpr std::uint32_t kRoot = 0xffffffffU;

struct BoxPair {
    std::uint32_t a, b;
    float bound_sq; ///< lower bound of the squared distance
};

using BoxPairs = boost::container::small_vector<BoxPair, 512>;

inline NodeRef ref_of(const Tree& tree, std::uint32_t name) {
    return name == kRoot ? NodeRef::node(0)
                         : tree.nodes[name / Node::kWidth].child[name % Node::kWidth];
}
inline Aabb box_of(const Tree& tree, std::uint32_t name) {
    return name == kRoot ? tree.bounds : tree.nodes[name / Node::kWidth].box(name % Node::kWidth);
}

/// No two points of the trees are farther apart.
inline float reach_sq(const PairTraversal& t) {
    const FrameMap& m = t.frame.a_from_b;
    float sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        float reach = std::abs(m.translation[i]) + m.margin +
                      std::max(std::abs(t.a.bounds.lower[i]), std::abs(t.a.bounds.upper[i]));
        for (std::size_t k = 0; k < 3; ++k)
            reach += m.magnitude[i][k] *
                     std::max(std::abs(t.b.bounds.lower[k]), std::abs(t.b.bounds.upper[k]));
        sum += reach * reach;
    }
    return sum * m.most_stretch_sq;
}

} // namespace abut::traverse_pair
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using traverse_pair::BoxPair;
using traverse_pair::BoxPairs;

using D = hn::CappedTag<float, Node::kWidth>;
using V = hn::Vec<D>;

HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return static_cast<std::uint32_t>(bits[0]) & ((1U << hn::MaxLanes(d)) - 1);
}

/// Squared distance bounds of one box to eight, in world units, and what they mean for a bound: a
/// bit for each child.
struct Bounds {
    HWY_ALIGN float lower_sq[Node::kWidth];
    HWY_ALIGN float gap[Node::kWidth]; ///< largest on an axis of the node; negative: overlap
    std::uint32_t used = 0;            ///< there is such a child
    std::uint32_t near = 0;            ///< it may be within the bound
    std::uint32_t accepted = 0;        ///< all of it is within the bound
};

/// The bounds of `box`, given in the other frame, to the children of `node`: the larger of what the
/// face axes of either frame show. `to_node` takes the box to the node's frame, `to_box` the
/// children to the box's.
template <bool with_upper>
HWY_INLINE void bound_children(const Node& node, const Aabb& box, const FrameMap& to_node,
                               const FrameMap& to_box, float bound_sq, Bounds& bounds) {
    const D d;
    float c[3], h[3], c_node[3], h_node[3];
    for (int i = 0; i < 3; ++i) {
        c[i] = 0.5F * (box.lower[i] + box.upper[i]);
        h[i] = 0.5F * (box.upper[i] - box.lower[i]);
    }
    for (int i = 0; i < 3; ++i) {
        c_node[i] = to_node.linear[i][0] * c[0] + to_node.linear[i][1] * c[1] +
                    to_node.linear[i][2] * c[2] + to_node.translation[i];
        h_node[i] = to_node.magnitude[i][0] * h[0] + to_node.magnitude[i][1] * h[1] +
                    to_node.magnitude[i][2] * h[2];
    }
    const auto zero = hn::Zero(d), half = hn::Set(d, 0.5F);
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        V centre[3], extent[3];
        auto gap_sq = zero, reach_sq = zero;
        auto largest_gap = hn::Set(d, hwy::LowestValue<float>());
        // Node frame: gap = |c - c'| - (h + h') - margin on each axis.
        for (int i = 0; i < 3; ++i) {
            const auto lower = hn::Load(d, node.lower[i] + lane),
                       upper = hn::Load(d, node.upper[i] + lane);
            centre[i] = hn::Mul(half, hn::Add(lower, upper));
            extent[i] = hn::Mul(half, hn::Sub(upper, lower));
            const auto apart = hn::Abs(hn::Sub(hn::Set(d, c_node[i]), centre[i]));
            const auto extents = hn::Add(hn::Set(d, h_node[i]), extent[i]);
            const auto rounded_gap = hn::Sub(apart, extents);
            largest_gap = hn::Max(largest_gap, rounded_gap);
            const auto gap = hn::Max(zero, hn::Sub(rounded_gap, hn::Set(d, to_node.margin)));
            gap_sq = hn::MulAdd(gap, gap, gap_sq);
            if constexpr (with_upper) {
                const auto reach = hn::Add(hn::Add(apart, extents), hn::Set(d, to_node.margin));
                reach_sq = hn::MulAdd(reach, reach, reach_sq);
            }
        }
        auto lower_sq = hn::Mul(gap_sq, hn::Set(d, to_node.stretch_sq));
        // Box frame: the children turned into it.
        gap_sq = zero;
        for (int i = 0; i < 3; ++i) {
            const auto* m = to_box.linear[i];
            const auto* a = to_box.magnitude[i];
            const auto c_box =
                hn::MulAdd(hn::Set(d, m[0]), centre[0],
                           hn::MulAdd(hn::Set(d, m[1]), centre[1],
                                      hn::MulAdd(hn::Set(d, m[2]), centre[2],
                                                 hn::Set(d, to_box.translation[i]))));
            const auto h_box = hn::MulAdd(
                hn::Set(d, a[0]), extent[0],
                hn::MulAdd(hn::Set(d, a[1]), extent[1], hn::Mul(hn::Set(d, a[2]), extent[2])));
            const auto apart = hn::Abs(hn::Sub(hn::Set(d, c[i]), c_box));
            const auto gap = hn::Max(zero, hn::Sub(hn::Sub(apart, hn::Add(hn::Set(d, h[i]), h_box)),
                                                   hn::Set(d, to_box.margin)));
            gap_sq = hn::MulAdd(gap, gap, gap_sq);
        }
        lower_sq = hn::Max(lower_sq, hn::Mul(gap_sq, hn::Set(d, to_box.stretch_sq)));
        hn::Store(lower_sq, d, bounds.lower_sq + lane);
        hn::Store(largest_gap, d, bounds.gap + lane);
        // Unused lanes hold an empty box. A bound that is not a number keeps the child.
        const auto used =
            hn::Le(hn::Load(d, node.lower[0] + lane), hn::Load(d, node.upper[0] + lane));
        bounds.used |= bits_of(d, used) << lane;
        bounds.near |= bits_of(d, hn::AndNot(hn::Gt(lower_sq, hn::Set(d, bound_sq)), used)) << lane;
        if constexpr (with_upper)
            bounds.accepted |=
                bits_of(d,
                        hn::And(used, hn::Le(hn::Mul(reach_sq, hn::Set(d, to_node.most_stretch_sq)),
                                             hn::Set(d, bound_sq))))
                << lane;
    }
}

/// Opens one box of the pair and adds the pairs within the bound. True if the bound is met by whole
/// boxes.
template <bool with_upper>
HWY_INLINE bool open_pair(PairTraversal& t, const BoxPair& pair, float bound_sq,
                          BoxPairs& pending) {
    using traverse_pair::box_of;
    using traverse_pair::ref_of;
    const NodeRef ref_a = ref_of(t.a, pair.a), ref_b = ref_of(t.b, pair.b);
    const Aabb box_a = box_of(t.a, pair.a), box_b = box_of(t.b, pair.b);
    const bool open_a =
        !ref_a.is_leaf() && (ref_b.is_leaf() || box_a.half_area() > box_b.half_area());
    const std::uint32_t index = (open_a ? ref_a : ref_b).index();
    const Node& node = (open_a ? t.a : t.b).nodes[index];
    Bounds bounds;
    if (open_a)
        bound_children<with_upper>(node, box_b, t.frame.a_from_b, t.frame.b_from_a, bound_sq,
                                   bounds);
    else
        bound_children<with_upper>(node, box_a, t.frame.b_from_a, t.frame.a_from_b, bound_sq,
                                   bounds);
    t.volume_tests += static_cast<std::uint64_t>(std::popcount(bounds.used));
    if (with_upper && bounds.accepted != 0)
        return true;
    const auto add = [&](std::uint32_t lane) {
        const std::uint32_t child = index * Node::kWidth + lane;
        if (open_a)
            pending.push_back({child, pair.b, bounds.lower_sq[lane]});
        else
            pending.push_back({pair.a, child, bounds.lower_sq[lane]});
    };
    // The child that overlaps deepest goes last, and so comes next: a contact is likeliest there.
    std::uint32_t deepest = Node::kWidth;
    for (std::uint32_t near = bounds.near; near != 0; near &= near - 1) {
        auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
        if (deepest == Node::kWidth || bounds.gap[lane] < bounds.gap[deepest])
            std::swap(lane, deepest);
        if (lane != Node::kWidth)
            add(lane);
    }
    if (deepest != Node::kWidth)
        add(deepest);
    return false;
}

/// What became of one pair: its leaves visited, or its children added to `found`.
template <bool with_upper>
HWY_INLINE bool step(PairTraversal& t, LeafPairVisitor& visitor, const BoxPair& pair,
                     float& bound_sq, BoxPairs& found, Verdict& verdict) {
    const NodeRef a = traverse_pair::ref_of(t.a, pair.a), b = traverse_pair::ref_of(t.b, pair.b);
    if (!a.is_leaf() || !b.is_leaf()) {
        verdict = Verdict::accepted;
        return !open_pair<with_upper>(t, pair, bound_sq, found);
    }
    const double new_bound_sq = visitor.visit(a, b);
    bound_sq = round_up(new_bound_sq);
    verdict = Verdict::stopped;
    return new_bound_sq >= 0;
}

template <bool with_upper>
Verdict traverse_stack(PairTraversal& t, LeafPairVisitor& visitor) {
    BoxPairs pending;
    pending.push_back({traverse_pair::kRoot, traverse_pair::kRoot, 0});
    float bound_sq = round_up(t.bound_sq);
    Verdict verdict = Verdict::done;
    while (!pending.empty()) {
        const BoxPair pair = pending.back();
        pending.pop_back();
        if (!(pair.bound_sq > bound_sq) &&
            !step<with_upper>(t, visitor, pair, bound_sq, pending, verdict))
            return verdict;
    }
    return Verdict::done;
}

Verdict traverse_nearest(PairTraversal& t, LeafPairVisitor& visitor) {
    float bound_sq = round_up(t.bound_sq);
    NearFirstQueue<BoxPair> pending(std::min(bound_sq, traverse_pair::reach_sq(t)));
    pending.push(0, {traverse_pair::kRoot, traverse_pair::kRoot, 0});
    BoxPairs found;
    Verdict verdict = Verdict::done;
    while (!pending.empty() && !pending.all_above(bound_sq)) {
        const BoxPair pair = pending.pop();
        if (pair.bound_sq > bound_sq)
            continue;
        found.clear();
        if (!step<false>(t, visitor, pair, bound_sq, found, verdict))
            return verdict;
        for (const BoxPair& child : found)
            pending.push(child.bound_sq, child);
    }
    return Verdict::done;
}

Verdict depth_first(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.accept_early ? traverse_stack<true>(t, visitor) : traverse_stack<false>(t, visitor);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(depth_first);
HWY_EXPORT(traverse_nearest);

Verdict traverse_depth_first(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.a.empty() || t.b.empty() ? Verdict::done
                                      : HWY_DYNAMIC_DISPATCH(depth_first)(t, visitor);
}
Verdict traverse_best_first(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.a.empty() || t.b.empty() ? Verdict::done
                                      : HWY_DYNAMIC_DISPATCH(traverse_nearest)(t, visitor);
}

} // namespace abut
#endif
