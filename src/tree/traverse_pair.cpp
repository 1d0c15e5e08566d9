#include "tree/traverse_pair.h"

#include "tree/near_first_queue.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_pair.cpp"
#include "simd/foreach_target.h"
#include "tree/node_pair-inl.h"

// What the targets share.
#ifndef ABUT_TREE_TRAVERSE_PAIR_ONCE
#define ABUT_TREE_TRAVERSE_PAIR_ONCE
namespace abut::traverse_pair {

/// More than underflow takes from a product. Without it, all is within a bound that is nearly 0.
constexpr float kUnderflow = std::numeric_limits<float>::min();
/// Where one box has so many times the surface of the other, it is opened alone.
constexpr float kUnlike = 4;

enum class Mode : std::uint8_t {
    contacts,
    within,
    nearest,
    descent, ///< to the children whose middles are nearest
};

/// Two boxes still to be looked at, by their names.
struct BoxPair {
    std::uint32_t a, b;
    float bound_sq; ///< lower bound of the squared distance
};
using BoxPairs = boost::container::small_vector<BoxPair, 256>;

/// A box by its middle and half extents, in the frame of a node.
struct MiddleBox {
    std::array<float, 3> centre{}, half{};

    MiddleBox() = default;
    explicit MiddleBox(const Aabb& box) {
        for (std::size_t i = 0; i < 3; ++i) {
            centre[i] = 0.5F * (box.lower[i] + box.upper[i]);
            half[i] = 0.5F * (box.upper[i] - box.lower[i]);
        }
    }
};

} // namespace abut::traverse_pair
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using traverse_pair::BoxPair;
using traverse_pair::BoxPairs;
using traverse_pair::MiddleBox;
using traverse_pair::Mode;

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
    std::uint32_t near = 0;            ///< it may be within the bound
    std::uint32_t accepted = 0;        ///< all of it is within the bound

    template <Mode mode>
    [[nodiscard]] float lower_bound_sq(std::uint32_t lane) const {
        return mode == Mode::contacts ? 0 : lower_sq[lane];
    }
};

/// How a box and a node's children are to be compared: `to_node` takes the box to the node's frame,
/// `to_box` the children to the box's; the direction points from the node to the box where `sign`
/// is 1.
struct Comparison {
    const FrameMap& to_node;
    const FrameMap& to_box;
    const Covector& n_node;
    const Covector& n_box;
    float sign;
};

/// The bounds of a box to the children of a node: the largest of what the face axes of either frame
/// show, and the direction.
template <Mode mode>
HWY_INLINE void bound_children(const Node& node, const MiddleBox& box, const Comparison& compare,
                               float bound_sq, Bounds& bounds) {
    const D d;
    const FrameMap &to_node = compare.to_node, &to_box = compare.to_box;
    HWY_ALIGN float c_node[4], h_node[4];
    combine(to_node.linear[0].data(), to_node.linear[1].data(), to_node.linear[2].data(),
            box.centre[0], box.centre[1], box.centre[2], to_node.translation.data(), c_node);
    combine(to_node.magnitude[0].data(), to_node.magnitude[1].data(), to_node.magnitude[2].data(),
            box.half[0], box.half[1], box.half[2], nullptr, h_node);
    const auto zero = hn::Zero(d), half = hn::Set(d, 0.5F);
    const auto margin_node = hn::Set(d, to_node.margin), margin_box = hn::Set(d, to_box.margin);
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        V centre[3], extent[3];
        auto gap_sq = zero, reach_sq = hn::Set(d, traverse_pair::kUnderflow);
        auto largest_gap = hn::Set(d, hwy::LowestValue<float>());
        // Node frame: gap = |c - c'| - (h + h') - margin on each axis.
        for (std::size_t i = 0; i < 3; ++i) {
            const auto lower = hn::Load(d, node.lower[i] + lane),
                       upper = hn::Load(d, node.upper[i] + lane);
            centre[i] = hn::Mul(half, hn::Add(lower, upper));
            extent[i] = hn::Mul(half, hn::Sub(upper, lower));
            const auto apart = hn::Abs(hn::Sub(hn::Set(d, c_node[i]), centre[i]));
            const auto extents = hn::Add(hn::Set(d, h_node[i]), extent[i]);
            const auto gap = hn::Sub(apart, extents);
            largest_gap = hn::Max(largest_gap, gap);
            if constexpr (mode != Mode::contacts) {
                const auto certain = hn::Max(zero, hn::Sub(gap, margin_node));
                gap_sq = hn::MulAdd(certain, certain, gap_sq);
            }
            if constexpr (mode == Mode::within) {
                const auto reach = hn::Add(hn::Add(apart, extents), margin_node);
                reach_sq = hn::MulAdd(reach, reach, reach_sq);
            }
            if constexpr (mode == Mode::descent)
                reach_sq = hn::MulAdd(apart, apart, reach_sq);
        }
        // Unused lanes hold an empty box. A bound that is not a number keeps the child.
        auto near = hn::Le(hn::Load(d, node.lower[0] + lane), hn::Load(d, node.upper[0] + lane));
        if constexpr (mode == Mode::descent) {
            hn::Store(reach_sq, d, bounds.lower_sq + lane);
            bounds.near |= bits_of(d, near) << lane;
            continue;
        }
        const auto used = near;
        auto lower_sq = hn::Mul(gap_sq, hn::Set(d, to_node.stretch_sq));
        if constexpr (mode == Mode::contacts) {
            near = hn::AndNot(hn::Gt(largest_gap, margin_node), near);
            hn::Store(largest_gap, d, bounds.gap + lane);
        } else {
            near = hn::AndNot(hn::Gt(lower_sq, hn::Set(d, bound_sq)), near);
        }
        if (hn::AllFalse(d, near))
            continue;
        // Box frame: the children turned into it.
        gap_sq = zero;
        largest_gap = hn::Set(d, hwy::LowestValue<float>());
        for (std::size_t i = 0; i < 3; ++i) {
            const float m[] = {to_box.linear[0][i], to_box.linear[1][i], to_box.linear[2][i]};
            const float a[] = {to_box.magnitude[0][i], to_box.magnitude[1][i],
                               to_box.magnitude[2][i]};
            const auto c_box =
                hn::MulAdd(hn::Set(d, m[0]), centre[0],
                           hn::MulAdd(hn::Set(d, m[1]), centre[1],
                                      hn::MulAdd(hn::Set(d, m[2]), centre[2],
                                                 hn::Set(d, to_box.translation[i]))));
            const auto h_box = hn::MulAdd(
                hn::Set(d, a[0]), extent[0],
                hn::MulAdd(hn::Set(d, a[1]), extent[1], hn::Mul(hn::Set(d, a[2]), extent[2])));
            const auto apart = hn::Abs(hn::Sub(hn::Set(d, box.centre[i]), c_box));
            const auto gap = hn::Sub(apart, hn::Add(hn::Set(d, box.half[i]), h_box));
            if constexpr (mode == Mode::contacts) {
                largest_gap = hn::Max(largest_gap, gap);
            } else {
                const auto certain = hn::Max(zero, hn::Sub(gap, margin_box));
                gap_sq = hn::MulAdd(certain, certain, gap_sq);
            }
        }
        if constexpr (mode == Mode::contacts) {
            near = hn::AndNot(hn::Gt(largest_gap, margin_box), near);
        } else {
            lower_sq = hn::Max(lower_sq, hn::Mul(gap_sq, hn::Set(d, to_box.stretch_sq)));
        }
        if constexpr (mode == Mode::nearest) {
            // n . (c - c') - (reach of either box along n) - margin, in world units.
            const Covector& n = compare.n_node;
            auto along = hn::Set(d, n[0] * c_node[0] + n[1] * c_node[1] + n[2] * c_node[2]);
            auto reach =
                hn::Set(d, reach_along(compare.n_box, box.half) +
                               (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2])) * to_node.margin);
            for (std::size_t i = 0; i < 3; ++i) {
                along = hn::NegMulAdd(hn::Set(d, n[i]), centre[i], along);
                reach = hn::MulAdd(hn::Set(d, std::abs(n[i])), extent[i], reach);
            }
            const auto certain = hn::Max(zero, hn::MulSub(hn::Set(d, compare.sign), along, reach));
            lower_sq = hn::Max(lower_sq, hn::Mul(certain, certain));
        }
        if constexpr (mode != Mode::contacts) {
            near = hn::AndNot(hn::Gt(lower_sq, hn::Set(d, bound_sq)), near);
            hn::Store(lower_sq, d, bounds.lower_sq + lane);
        }
        bounds.near |= bits_of(d, near) << lane;
        if constexpr (mode == Mode::within)
            bounds.accepted |=
                bits_of(d, hn::And(used,
                                   hn::Le(hn::MulAdd(reach_sq, hn::Set(d, to_node.most_stretch_sq),
                                                     hn::Set(d, traverse_pair::kUnderflow)),
                                          hn::Set(d, bound_sq))))
                << lane;
    }
}

/// One traversal of a pair of trees.
template <Mode mode>
class PairWalk {
public:
    PairWalk(PairTraversal& t, LeafPairVisitor& visitor)
        : t_(t), visitor_(visitor), bound_sq_(round_up(t.bound_sq)) {
        if constexpr (mode == Mode::nearest)
            take_direction();
    }

    Verdict depth_first() {
        found_.push_back({kRootName, kRootName, 0});
        return drain() ? Verdict::done : verdict_;
    }

    /// Visits one pair of leaves that seem to be near each other.
    Verdict descend() {
        BoxPair pair{kRootName, kRootName, 0};
        while (true) {
            found_.clear();
            if (!step(pair))
                return verdict_;
            if (found_.empty())
                return Verdict::done;
            pair = *std::min_element(
                found_.begin(), found_.end(),
                [](const BoxPair& x, const BoxPair& y) { return x.bound_sq < y.bound_sq; });
        }
    }

    Verdict nearest_first() {
        NearFirstQueue<BoxPair> pending(std::min(bound_sq_, t_.frame.reach_sq));
        pending.push(0, {kRootName, kRootName, 0});
        while (!pending.empty() && !pending.all_above(bound_sq_)) {
            const BoxPair pair = pending.pop();
            if (pair.bound_sq > bound_sq_)
                continue;
            found_.clear();
            if (!step(pair))
                return verdict_;
            if (pending.size() < t_.queue_limit)
                for (const BoxPair& child : found_)
                    pending.push(child.bound_sq, child);
            else if (!drain())
                return verdict_;
        }
        return Verdict::done;
    }

    [[nodiscard]] float bound_sq() const { return bound_sq_; }

private:
    /// Looks at all that was found, last first. False: stop, with a verdict.
    bool drain() {
        while (!found_.empty()) {
            const BoxPair pair = found_.back();
            found_.pop_back();
            if (!(pair.bound_sq > bound_sq_) && !step(pair))
                return false;
        }
        return true;
    }

    /// Looks at one pair: adds what is near below it to `found_`. False: stop, with a verdict.
    bool step(const BoxPair& pair) {
        const NodeRef a = t_.a.named(pair.a), b = t_.b.named(pair.b);
        const Node& p = t_.a.nodes[a.is_leaf() ? node_of(pair.a) : a.index()];
        const Node& q = t_.b.nodes[b.is_leaf() ? node_of(pair.b) : b.index()];
        NodePair nodes(t_.frame, p, q);
        if (has_direction_) {
            nodes.n_p = p.frame.vector_from_tree(direction_a_);
            nodes.n_q = q.frame.vector_from_tree(direction_b_);
        }
        if (a.is_leaf() && b.is_leaf())
            return visit(nodes, a, b);
        if (a.is_leaf())
            return open_b(nodes, pair.a, MiddleBox(p.box(lane_of(pair.a))), b.index());
        if (b.is_leaf())
            return open_a(nodes, a.index(), pair.b, MiddleBox(q.box(lane_of(pair.b))));
        const float area_a = p.bounds.half_area() * stretch_a(), area_b = q.bounds.half_area();
        if (area_a > traverse_pair::kUnlike * area_b)
            return open_a(nodes, a.index(), pair.b, MiddleBox(q.bounds));
        if (area_b > traverse_pair::kUnlike * area_a)
            return open_b(nodes, pair.a, MiddleBox(p.bounds), b.index());
        return open_both(nodes, a.index(), b.index());
    }

    /// Areas of a in the units of b's frame, roughly.
    [[nodiscard]] float stretch_a() const {
        return t_.frame.a_from_b.stretch_sq / t_.frame.b_from_a.stretch_sq;
    }

    bool compare(const Node& node, const MiddleBox& box, const Comparison& comparison,
                 Bounds& bounds) {
        bound_children<mode>(node, box, comparison, bound_sq_, bounds);
        t_.volume_tests += Node::kWidth;
        if (mode == Mode::within && bounds.accepted != 0) {
            verdict_ = Verdict::accepted;
            return false;
        }
        return true;
    }

    bool open_a(const NodePair& nodes, std::uint32_t p, std::uint32_t name_b,
                const MiddleBox& box_b) {
        Bounds bounds;
        if (!compare(t_.a.nodes[p], box_b,
                     {nodes.p_from_q, nodes.q_from_p, nodes.n_p, nodes.n_q, 1}, bounds))
            return false;
        return add(bounds, nodes, [&](std::uint32_t lane) {
            return BoxPair{child_name(p, lane), name_b, bounds.lower_bound_sq<mode>(lane)};
        });
    }
    bool open_b(const NodePair& nodes, std::uint32_t name_a, const MiddleBox& box_a,
                std::uint32_t q) {
        Bounds bounds;
        if (!compare(t_.b.nodes[q], box_a,
                     {nodes.q_from_p, nodes.p_from_q, nodes.n_q, nodes.n_p, -1}, bounds))
            return false;
        return add(bounds, nodes, [&](std::uint32_t lane) {
            return BoxPair{name_a, child_name(q, lane), bounds.lower_bound_sq<mode>(lane)};
        });
    }
    bool open_both(const NodePair& nodes, std::uint32_t p, std::uint32_t q) {
        const Node& node_p = t_.a.nodes[p];
        const Node& node_q = t_.b.nodes[q];
        Bounds of_p;
        if (!compare(node_p, MiddleBox(node_q.bounds),
                     {nodes.p_from_q, nodes.q_from_p, nodes.n_p, nodes.n_q, 1}, of_p))
            return false;
        // The child that overlaps deepest goes last, and so comes next: a contact is likeliest
        // there.
        std::uint32_t deepest = Node::kWidth;
        for (std::uint32_t near = of_p.near; near != 0; near &= near - 1) {
            auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
            if (mode == Mode::contacts &&
                (deepest == Node::kWidth || of_p.gap[lane] < of_p.gap[deepest]))
                std::swap(lane, deepest);
            if (lane != Node::kWidth &&
                !open_b(nodes, child_name(p, lane), MiddleBox(node_p.box(lane)), q))
                return false;
        }
        return deepest == Node::kWidth ||
               open_b(nodes, child_name(p, deepest), MiddleBox(node_p.box(deepest)), q);
    }

    /// Adds the children that are near; pairs of leaves are visited at once where order does not
    /// matter.
    template <class Pair>
    bool add(const Bounds& bounds, const NodePair& nodes, const Pair& pair_of) {
        std::uint32_t deepest = Node::kWidth;
        for (std::uint32_t near = bounds.near; near != 0; near &= near - 1) {
            auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
            if (mode == Mode::contacts &&
                (deepest == Node::kWidth || bounds.gap[lane] < bounds.gap[deepest]))
                std::swap(lane, deepest);
            if (lane != Node::kWidth && !add(nodes, pair_of(lane)))
                return false;
        }
        return deepest == Node::kWidth || add(nodes, pair_of(deepest));
    }
    bool add(const NodePair& nodes, const BoxPair& pair) {
        if (mode != Mode::descent && (mode != Mode::nearest || has_direction_)) {
            if (pair.bound_sq > bound_sq_)
                return true;
            const NodeRef a = t_.a.named(pair.a), b = t_.b.named(pair.b);
            if (a.is_leaf() && b.is_leaf())
                return visit(nodes, a, b);
        }
        found_.push_back(pair);
        return true;
    }

    bool visit(const NodePair& nodes, NodeRef a, NodeRef b) {
        t_.primitive_tests += std::uint64_t{a.count()} * b.count();
        const LeafPairs pairs =
            compare_leaves(t_.a, a, t_.b, b, nodes, mode == Mode::contacts, bound_sq_);
        if (pairs.any() == 0)
            return true;
        const double new_bound_sq = visitor_.visit(a, b, pairs);
        if (!(new_bound_sq >= 0)) {
            verdict_ = Verdict::stopped;
            return false;
        }
        if constexpr (mode == Mode::nearest)
            if (round_up(new_bound_sq) < bound_sq_)
                take_direction();
        bound_sq_ = round_up(new_bound_sq);
        return true;
    }

    void take_direction() {
        const Vec3 n = visitor_.direction();
        if (n == Vec3{})
            return;
        // A vector v of a tree's frame has length n . L v along the direction n of the world, L the
        // linear part of its transform.
        const auto seen_in = [&](const Transform& world) {
            constexpr double kBelowOne = 1 - 0x1p-20;
            Covector seen{};
            for (std::size_t i = 0; i < 3; ++i)
                seen[i] = static_cast<float>(
                    kBelowOne *
                    (n.x * world.m[3 * i] + n.y * world.m[3 * i + 1] + n.z * world.m[3 * i + 2]));
            return seen;
        };
        direction_a_ = seen_in(t_.frame.world_from_a);
        direction_b_ = seen_in(t_.frame.world_from_b);
        has_direction_ = true;
    }

    PairTraversal& t_;
    LeafPairVisitor& visitor_;
    float bound_sq_;
    Verdict verdict_ = Verdict::done;
    BoxPairs found_;
    Covector direction_a_{}, direction_b_{};
    bool has_direction_ = false;
};

Verdict contacts(PairTraversal& t, LeafPairVisitor& visitor) {
    return PairWalk<Mode::contacts>(t, visitor).depth_first();
}
Verdict within_bound(PairTraversal& t, LeafPairVisitor& visitor) {
    return PairWalk<Mode::within>(t, visitor).depth_first();
}
Verdict nearest(PairTraversal& t, LeafPairVisitor& visitor) {
    if (!(t.bound_sq < t.frame.reach_sq)) {
        PairWalk<Mode::descent> walk(t, visitor);
        if (walk.descend() == Verdict::stopped)
            return Verdict::stopped;
        t.bound_sq = walk.bound_sq();
    }
    return PairWalk<Mode::nearest>(t, visitor).nearest_first();
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(contacts);
HWY_EXPORT(within_bound);
HWY_EXPORT(nearest);

Verdict traverse_contacts(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.a.empty() || t.b.empty() ? Verdict::done : HWY_DYNAMIC_DISPATCH(contacts)(t, visitor);
}
Verdict traverse_within(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.a.empty() || t.b.empty() ? Verdict::done
                                      : HWY_DYNAMIC_DISPATCH(within_bound)(t, visitor);
}
Verdict traverse_nearest(PairTraversal& t, LeafPairVisitor& visitor) {
    return t.a.empty() || t.b.empty() ? Verdict::done : HWY_DYNAMIC_DISPATCH(nearest)(t, visitor);
}

} // namespace abut
#endif
