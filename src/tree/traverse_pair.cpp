#include "tree/traverse_pair.h"

#include "core/set_bits.h"
#include "math/rounding.h"
#include "tree/near_first_queue.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_pair.cpp"
#include "simd/foreach_target.h"
#include "geometry/leaf/leaf_group-inl.h"
#include "tree/child_pairs-inl.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_TRAVERSE_PAIR_ONCE
#define ABUT_TREE_TRAVERSE_PAIR_ONCE
namespace abut::traverse_pair {

/// A node with more than this many times the other's surface area is opened alone. The value is
/// about the ratio of areas between two levels of a tree.
constexpr float kUnlike = 8;

/// Leaves are compared in groups if the bound has not shrunk for this many groups: those of one group
/// are compared with one bound.
constexpr std::uint32_t kSettled = 4;

/// A pair of boxes that waits for its test, given by the boxes' names.
struct BoxPair {
    std::uint32_t a, b;
    float
        bound_sq; ///< `value` of compare_row: for most tests a lower bound of the squared distance
};
using BoxPairs = boost::container::small_vector<BoxPair, 256>;

} // namespace abut::traverse_pair
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using traverse_pair::BoxPair;
using traverse_pair::BoxPairs;
/// One traversal of a pair of trees.
template <BoxTest test>
class PairWalk {
public:
    PairWalk(PairTraversal& t, LeafPairVisitor& visitor)
        : t_(t), visitor_(visitor), bound_sq_(round_up(t.bound_sq)) {
        if constexpr (test == BoxTest::nearest)
            take_direction();
    }

    Verdict depth_first() {
        found_.push_back({kRootName, kRootName, 0});
        return drain() ? Verdict::done : verdict_;
    }

    /// Follows the nearest pair of boxes down to one pair of leaves, and visits it.
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
            if (!t_.steps.take()) {
                verdict_ = Verdict::out_of_steps;
                break;
            }
            const BoxPair pair = pending.pop();
            if (pair.bound_sq > bound_sq_)
                continue;
            if (!step(pair))
                return verdict_;
            if (pending.size() < t_.queue_limit) {
                for (const BoxPair& child : found_)
                    pending.push(child.bound_sq, child);
                found_.clear();
            } else if (!drain()) {
                break;
            }
        }
        if (verdict_ == Verdict::out_of_steps)
            leave(pending);
        return verdict_;
    }

    [[nodiscard]] float bound_sq() const { return bound_sq_; }

private:
    /// Records the lower bounds of all pairs that are not visited.
    void leave(NearFirstQueue<BoxPair>& pending) {
        for (const BoxPair& pair : found_)
            t_.leave(pair.bound_sq);
        while (!pending.empty())
            t_.leave(pending.pop().bound_sq);
    }

    /// Tests all pairs in `found_`, the last one first. Returns false, with a verdict set, to stop.
    bool drain() {
        while (!found_.empty()) {
            if (!t_.steps.take()) {
                verdict_ = Verdict::out_of_steps;
                return false;
            }
            const BoxPair pair = found_.back();
            found_.pop_back();
            if (!(pair.bound_sq > bound_sq_) && !step(pair))
                return false;
        }
        return true;
    }

    /// A node of a pair, and which of its children are to be compared.
    struct Side {
        std::uint32_t index;
        const Node& node;
        const Siblings& children;
        std::uint32_t lanes;
    };

    /// Tests one pair and adds the nearby pairs below it to `found_`. Returns false, with a verdict
    /// set, to stop.
    bool step(const BoxPair& pair) {
        const NodeRef a = t_.a.named(pair.a), b = t_.b.named(pair.b);
        bool open_a = !a.is_leaf(), open_b = !b.is_leaf();
        if (open_a && open_b)
            open_larger(pair, open_a, open_b);
        // A box that is not opened is compared as a child of the node above it.
        const std::uint32_t index_p = open_a ? a.index() : node_of(pair.a),
                            index_q = open_b ? b.index() : node_of(pair.b);
        const Node &p = t_.a.nodes[index_p], &q = t_.b.nodes[index_q];
        NodePair nodes;
        if (has_direction_) {
            nodes.n_p = p.frame.vector_from_tree(direction_a_);
            nodes.n_q = q.frame.vector_from_tree(direction_b_);
        }
        between_nodes(t_.frame.a_from_b, p, q, nodes.p_from_q);
        if (a.is_leaf() && b.is_leaf())
            return visit(nodes, a, b);
        // Many pairs of nodes end here: no child of one is near the other. The second is turned
        // only if a child of the first is left.
        Siblings children_p, children_q;
        see_children(q, nodes.p_from_q, children_q);
        Side of_p{index_p, p, children_p, 0},
            of_q{index_q, q, children_q, children_q.used & opened_lanes(open_b, pair.b)};
        const bool both = open_a && open_b && test != BoxTest::middles;
        float advance_p = 0, advance_q = 0;
        if (test == BoxTest::nearest) {
            sum_along(children_q.seen.centre, nodes.n_p, children_q.own.half, nodes.n_q, -1, 0,
                      children_q.advance);
            advance_p = advance_of(p.bounds, nodes.n_p, nodes.p_from_q.margin);
        }
        if (both) {
            of_q.lanes &=
                near_box<test>(children_q, nodes.p_from_q, p.bounds, bound_sq_, advance_p);
            t_.volume_tests += Node::kWidth;
            if (of_q.lanes == 0)
                return true;
        }
        between_nodes(t_.frame.b_from_a, q, p, nodes.q_from_p);
        see_children(p, nodes.q_from_p, children_p);
        take_margins(nodes.p_from_q, children_p);
        take_margins(nodes.q_from_p, children_q);
        of_p.lanes = children_p.used & opened_lanes(open_a, pair.a);
        if (test == BoxTest::nearest) {
            sum_along(children_p.own.centre, nodes.n_p, children_p.own.half, nodes.n_p, 1,
                      length_1(nodes.n_p) * nodes.p_from_q.margin, children_p.advance);
            advance_q = most_of(children_q.advance, of_q.lanes);
        }
        if (both) {
            of_p.lanes &=
                near_box<test>(children_p, nodes.q_from_p, q.bounds, bound_sq_, advance_q);
            t_.volume_tests += Node::kWidth;
            if (of_p.lanes == 0)
                return true;
        }
        // The side with fewer children is taken one by one, each against all of the other side.
        return std::popcount(of_p.lanes) <= std::popcount(of_q.lanes)
                   ? compare<false>(nodes, of_p, of_q)
                   : compare<true>(nodes, of_q, of_p);
    }

    /// The lanes of a node that count: all, or the one of the box that is not opened.
    static std::uint32_t opened_lanes(bool open, std::uint32_t name) {
        return open ? 0xffU : 1U << lane_of(name);
    }
    /// If two nodes differ much in size, opens only the larger one.
    void open_larger(const BoxPair& pair, bool& open_a, bool& open_b) const {
        const float area_a = t_.a.nodes[t_.a.named(pair.a).index()].bounds.half_area() *
                             t_.frame.a_from_b.stretch_sq / t_.frame.b_from_a.stretch_sq,
                    area_b = t_.b.nodes[t_.b.named(pair.b).index()].bounds.half_area();
        if (pair.b != kRootName && area_a > traverse_pair::kUnlike * area_b)
            open_b = false;
        else if (pair.a != kRootName && area_b > traverse_pair::kUnlike * area_a)
            open_a = false;
    }

    /// Pairs of children. Bit 8 i + j stands for child i of one node and child j of the other.
    struct PairSet {
        std::uint64_t near = 0;
        std::uint64_t leaves = 0;                          ///< those pairs in `near` that are two
                                                           ///< leaves
        HWY_ALIGN float value[Node::kWidth][Node::kWidth]; ///< as compare_row returns it
    };

    /// Compares the children of x with those of y; y belongs to a if `y_is_a`. Pairs of leaves are
    /// visited at once where the order does not matter.
    template <bool y_is_a>
    bool compare(const NodePair& nodes, const Side& x, const Side& y) {
        PairSet pairs;
        if (!measure(x, y, pairs))
            return false;
        if (test != BoxTest::middles && (test != BoxTest::nearest || has_direction_)) {
            if (pairs.leaves != 0) {
                const bool go_on = test == BoxTest::overlap || settled_ >= traverse_pair::kSettled
                                       ? visit_leaves<y_is_a>(nodes, x, y, pairs)
                                       : visit_each_leaf<y_is_a>(nodes, x, y, pairs);
                if (!go_on)
                    return false;
                ++settled_;
            }
            pairs.near &= ~pairs.leaves;
        }
        add<y_is_a>(x, y, pairs);
        return true;
    }

    bool measure(const Side& x, const Side& y, PairSet& pairs) {
        const std::uint32_t leaves_x = leaf_lanes(x.node), leaves_y = leaf_lanes(y.node);
        for (const std::uint32_t i : SetBits(x.lanes)) {
            const RowOfPairs row =
                compare_row<test>(x.children, i, y.children, bound_sq_, pairs.value[i]);
            t_.volume_tests += Node::kWidth;
            if (test == BoxTest::within && (row.accepted & y.lanes) != 0) {
                verdict_ = Verdict::accepted;
                return false;
            }
            const std::uint64_t near = row.near & y.lanes,
                                leaves = (leaves_x >> i & 1U) != 0 ? near & leaves_y : 0;
            pairs.near |= near << (Node::kWidth * i);
            pairs.leaves |= leaves << (Node::kWidth * i);
        }
        return true;
    }

    /// Compares the pairs of leaves one after the other, each with the bound that the one before has
    /// left.
    template <bool y_is_a>
    bool visit_each_leaf(const NodePair& nodes, const Side& x, const Side& y,
                         const PairSet& pairs) {
        for (const std::uint32_t bit : SetBits(pairs.leaves)) {
            const std::uint32_t i = bit / Node::kWidth, j = bit % Node::kWidth;
            if (pairs.value[i][j] > bound_sq_) // the bound may have shrunk since
                continue;
            const NodeRef leaf_x = x.node.child[i], leaf_y = y.node.child[j];
            if (!(y_is_a ? visit(nodes, leaf_y, leaf_x) : visit(nodes, leaf_x, leaf_y)))
                return false;
        }
        return true;
    }

    /// Compares the triangles of all pairs of leaves, and hands those that may matter to the
    /// visitor. Lanes are filled with the triangle pairs of several pairs of leaves.
    template <bool y_is_a>
    bool visit_leaves(const NodePair& nodes, const Side& x, const Side& y, const PairSet& pairs) {
        constexpr bool kWithNear = test != BoxTest::overlap;
        LeafGroup<kWithNear> group(nodes.p_from_q, leaf_bound(nodes, bound_sq_));
        std::uint32_t of_x = 0, of_y = 0;
        for (std::uint32_t i = 0; i < Node::kWidth; ++i) {
            const auto row = static_cast<std::uint32_t>(pairs.leaves >> (Node::kWidth * i) & 0xffU);
            of_x |= (row != 0 ? 1U : 0U) << i;
            of_y |= row;
        }
        const auto set = [&](const Side& side, std::uint32_t lanes, bool is_a) {
            for (const std::uint32_t i : SetBits(lanes))
                if (is_a)
                    group.set_a(i, t_.a.leaf(side.node.child[i]));
                else
                    group.set_b(i, t_.b.leaf(side.node.child[i]));
        };
        prefetch_leaves(y_is_a ? t_.b : t_.a, x.node, of_x);
        prefetch_leaves(y_is_a ? t_.a : t_.b, y.node, of_y);
        set(x, of_x, !y_is_a);
        set(y, of_y, y_is_a);
        std::uint64_t handed = pairs.leaves; // those still to be handed on
        std::size_t k = 0;
        const auto hand_on_complete = [&] {
            for (; k < group.complete(); ++k, handed &= handed - 1) {
                const LeafPairs found = group.pairs(k);
                if (found.any() == 0)
                    continue;
                const auto bit = static_cast<std::uint32_t>(std::countr_zero(handed));
                const std::uint32_t i = bit / Node::kWidth, j = bit % Node::kWidth;
                if (pairs.value[i][j] > bound_sq_) // the bound may have shrunk since
                    continue;
                const NodeRef leaf_x = x.node.child[i], leaf_y = y.node.child[j];
                if (!(y_is_a ? hand_on(leaf_y, leaf_x, found) : hand_on(leaf_x, leaf_y, found)))
                    return false;
            }
            return true;
        };
        for (const std::uint32_t bit : SetBits(pairs.leaves)) {
            const std::uint32_t i = bit / Node::kWidth, j = bit % Node::kWidth;
            const std::uint32_t count_x = x.node.child[i].count(),
                                count_y = y.node.child[j].count();
            t_.primitive_tests += std::uint64_t{count_x} * count_y;
            if (y_is_a)
                group.add(j, i, used_pairs(count_y, count_x));
            else
                group.add(i, j, used_pairs(count_x, count_y));
            if (group.fills_lanes()) {
                group.decide(false);
                if (!hand_on_complete())
                    return false;
            }
        }
        group.decide(true);
        return hand_on_complete();
    }

    template <bool y_is_a>
    void add(const Side& x, const Side& y, const PairSet& pairs) {
        const std::size_t before = found_.size();
        const auto count = static_cast<std::size_t>(std::popcount(pairs.near));
        found_.resize(before + count, boost::container::default_init);
        BoxPair* next = found_.data() + before;
        BoxPair* deepest = next;
        for (const std::uint32_t bit : SetBits(pairs.near)) {
            const std::uint32_t i = bit / Node::kWidth, j = bit % Node::kWidth;
            const std::uint32_t name_x = child_name(x.index, i), name_y = child_name(y.index, j);
            *next = {y_is_a ? name_y : name_x, y_is_a ? name_x : name_y, pairs.value[i][j]};
            deepest = next->bound_sq < deepest->bound_sq ? next : deepest;
            prefetch(x.node.child[i], y_is_a ? t_.b : t_.a);
            prefetch(y.node.child[j], y_is_a ? t_.a : t_.b);
            ++next;
        }
        // The pair that overlaps deepest goes last, so that it is tested next: a contact is
        // likeliest there.
        if (test == BoxTest::overlap && count > 0)
            std::swap(*deepest, found_.back());
    }

    bool visit(const NodePair& nodes, NodeRef a, NodeRef b) {
        t_.primitive_tests += std::uint64_t{a.count()} * b.count();
        const LeafPairs pairs =
            compare_leaves(t_.a, a, t_.b, b, nodes, test == BoxTest::overlap, bound_sq_);
        return pairs.any() == 0 || hand_on(a, b, pairs);
    }

    bool hand_on(NodeRef a, NodeRef b, const LeafPairs& pairs) {
        const double new_bound_sq = visitor_.visit(a, b, pairs);
        if (!(new_bound_sq >= 0)) {
            verdict_ = Verdict::stopped;
            return false;
        }
        const float bound_sq = round_up(new_bound_sq);
        if (bound_sq < bound_sq_) {
            settled_ = 0;
            if constexpr (test == BoxTest::nearest)
                take_direction();
        }
        bound_sq_ = bound_sq;
        return true;
    }

    void take_direction() {
        const Vec3 n = visitor_.direction();
        if (n == Vec3{})
            return;
        // A vector v of a tree's frame has length n . L v along the world direction n, where L is
        // the linear part of the tree's transform.
        const auto seen_in = [&](const Transform& world) {
            constexpr double kBelowOne = 1 - 0x1p-20;
            Covector seen{};
            for (std::size_t i = 0; i < 3; ++i)
                seen[i] = to_float(kBelowOne * (n.x * world.m[3 * i] + n.y * world.m[3 * i + 1] +
                                                n.z * world.m[3 * i + 2]));
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
    std::uint32_t settled_ = 0; ///< groups of leaves compared since the bound shrank
};

Verdict contacts(PairTraversal& t, LeafPairVisitor& visitor) {
    return PairWalk<BoxTest::overlap>(t, visitor).depth_first();
}
Verdict within_bound(PairTraversal& t, LeafPairVisitor& visitor) {
    return PairWalk<BoxTest::within>(t, visitor).depth_first();
}
Verdict nearest(PairTraversal& t, LeafPairVisitor& visitor) {
    if (!(t.bound_sq < t.frame.reach_sq)) {
        PairWalk<BoxTest::middles> walk(t, visitor);
        if (walk.descend() == Verdict::stopped)
            return Verdict::stopped;
        t.bound_sq = walk.bound_sq();
    }
    return PairWalk<BoxTest::nearest>(t, visitor).nearest_first();
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
