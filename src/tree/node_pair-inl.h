// The relative placement of two nodes of two trees, and the comparison of two leaves. Every
// traversal of a pair of trees ends here.

// Included once for each target.
#if defined(ABUT_TREE_NODE_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_TREE_NODE_PAIR_INL_H
#undef ABUT_TREE_NODE_PAIR_INL_H
#else
#define ABUT_TREE_NODE_PAIR_INL_H
#endif

#include "core/set_bits.h"
#include "math/rounding.h"
#include "simd/simd.h"
#include "tree/pair_frame.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Row = hn::CappedTag<float, 4>;

/// result = x v0 + y v1 + z v2, plus t if it is given. All are vectors of four floats.
HWY_INLINE void combine(const float* v0, const float* v1, const float* v2, float x, float y,
                        float z, const float* t, float* result) {
    const Row d;
    for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
        auto sum = hn::Mul(hn::Set(d, x), hn::Load(d, v0 + i));
        if (t != nullptr)
            sum = hn::Add(sum, hn::LoadU(d, t + i));
        sum = hn::MulAdd(hn::Set(d, y), hn::Load(d, v1 + i), sum);
        sum = hn::MulAdd(hn::Set(d, z), hn::Load(d, v2 + i), sum);
        hn::Store(sum, d, result + i);
    }
}

// x_to = A_to (M (A_from^T x_from + o_from) + t - o_to), A the nodes' rotations. The origins
// largely cancel. Their difference is computed in double, so that the error is relative to the
// nodes' sizes and their distance.
HWY_INLINE void between_nodes(const TreeMap& trees, const Node& to, const Node& from,
                              FrameMap& map) {
    const auto& turn = to.frame.turn;
    HWY_ALIGN float turned[3][4]; // the columns of A_to M
    for (std::size_t k = 0; k < 3; ++k)
        combine(turn[0].data(), turn[1].data(), turn[2].data(), trees.linear[0][k],
                trees.linear[1][k], trees.linear[2][k], nullptr, turned[k]);
    const Row d;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = from.frame.turn;
        combine(turned[0], turned[1], turned[2], t[0][k], t[1][k], t[2][k], nullptr,
                map.linear[k].data());
        for (std::size_t i = 0; i < 4; i += hn::Lanes(d))
            hn::Store(hn::Abs(hn::Load(d, map.linear[k].data() + i)), d,
                      map.magnitude[k].data() + i);
    }
    const hn::CappedTag<double, 4> d2;
    HWY_ALIGN double moved[4];
    for (std::size_t i = 0; i < 4; i += hn::Lanes(d2)) {
        auto sum = hn::LoadU(d2, trees.to_from[3].data() + i);
        for (std::size_t k = 0; k < 3; ++k)
            sum = hn::MulAdd(hn::Set(d2, double{from.frame.origin[k]}),
                             hn::LoadU(d2, trees.to_from[k].data() + i), sum);
        hn::Store(sum, d2, moved + i);
    }
    float between[3];
    for (std::size_t i = 0; i < 3; ++i)
        between[i] = to_float(moved[i] - double{to.frame.origin[i]});
    combine(turn[0].data(), turn[1].data(), turn[2].data(), between[0], between[1], between[2],
            nullptr, map.translation.data());
    const float size = to.reach + 2 * trees.row_sum * from.reach +
                       2 * (std::abs(between[0]) + std::abs(between[1]) + std::abs(between[2]));
    map.margin = 24 * 0x1p-24F * size + trees.margin;
    map.stretch_sq = trees.stretch_sq;
    map.most_stretch_sq = trees.most_stretch_sq;
}

/// The relative placement of two nodes, p of a and q of b.
struct NodePair {
    FrameMap p_from_q, q_from_p;
    Covector n_p{}, n_q{}; ///< the direction from a to b, as seen in either frame

    /// The maps are still to be set, by between_nodes.
    HWY_INLINE NodePair() = default;
    HWY_INLINE NodePair(const PairFrame& frame, const Node& p, const Node& q) {
        between_nodes(frame.a_from_b, p, q, p_from_q);
        between_nodes(frame.b_from_a, q, p, q_from_p);
    }
};

/// Prefetches a node, which will be needed soon, but not next.
HWY_INLINE void prefetch(NodeRef ref, const Tree& tree) {
    constexpr std::size_t kLine = 64;
    if (ref.is_leaf())
        return;
    const auto* node = reinterpret_cast<const unsigned char*>(&tree.nodes[ref.index()]);
    for (std::size_t i = 0; i < sizeof(Node); i += kLine)
        hwy::Prefetch(node + i);
}

HWY_INLINE void prefetch_leaves(const Tree& tree, const Node& node, std::uint32_t lanes) {
    for (const std::uint32_t i : SetBits(lanes)) {
        const auto* leaf = reinterpret_cast<const unsigned char*>(&tree.leaf(node.child[i]));
        hwy::Prefetch(leaf);
        hwy::Prefetch(leaf + 64);
        hwy::Prefetch(leaf + 128);
    }
}

/// The bound for the triangles of two leaves. In: bound_sq is a squared distance in the world.
HWY_INLINE LeafBound leaf_bound(const NodePair& nodes, float bound_sq) {
    return {bound_sq / nodes.p_from_q.stretch_sq * (1 + 0x1p-20F), bound_sq, nodes.n_p};
}

/// The pairs of triangles of two leaves with these counts. Lanes beyond the counts repeat the first
/// triangle.
HWY_INLINE std::uint32_t used_pairs(std::uint32_t count_a, std::uint32_t count_b) {
    constexpr std::uint32_t kRows[] = {0x000f, 0x00ff, 0x0fff, 0xffff};
    constexpr std::uint32_t kColumns[] = {0x1111, 0x3333, 0x7777, 0xffff};
    return kRows[count_a - 1] & kColumns[count_b - 1];
}

/// Compares the triangles of two leaves, which are children of the nodes. Returns the pairs that
/// may meet and, unless only contacts matter, the pairs that may be within the bound (squared, in
/// the world).
HWY_INLINE LeafPairs compare_leaves(const Tree& tree_a, NodeRef a, const Tree& tree_b, NodeRef b,
                                    const NodePair& nodes, bool contacts_only, float bound_sq) {
    const TriangleLeaf &leaf_a = tree_a.leaf(a), &leaf_b = tree_b.leaf(b);
    LeafPairs pairs = contacts_only
                          ? meeting_pairs(leaf_a, leaf_b, nodes.p_from_q)
                          : near_pairs(leaf_a, leaf_b, nodes.p_from_q, leaf_bound(nodes, bound_sq));
    const std::uint32_t used = used_pairs(a.count(), b.count());
    pairs.cross &= used;
    pairs.may_meet &= used;
    pairs.may_be_near &= used;
    return pairs;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
