// The relative placement of two nodes of two trees, and the comparison of two leaves. Every
// traversal of a pair of trees ends here.

// Included once for each target.
#if defined(ABUT_TREE_NODE_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_TREE_NODE_PAIR_INL_H
#undef ABUT_TREE_NODE_PAIR_INL_H
#else
#define ABUT_TREE_NODE_PAIR_INL_H
#endif

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

    HWY_INLINE NodePair(const PairFrame& frame, const Node& p, const Node& q) {
        between_nodes(frame.a_from_b, p, q, p_from_q);
        between_nodes(frame.b_from_a, q, p, q_from_p);
    }
};

/// Compares the triangles of two leaves, which are children of the nodes. Returns the pairs that
/// may meet and, unless only contacts matter, the pairs that may be within the bound (squared, in
/// the world).
HWY_INLINE LeafPairs compare_leaves(const Tree& tree_a, NodeRef a, const Tree& tree_b, NodeRef b,
                                    const NodePair& nodes, bool contacts_only, float bound_sq) {
    const TriangleLeaf &leaf_a = tree_a.leaf(a), &leaf_b = tree_b.leaf(b);
    LeafPairs pairs;
    if (contacts_only)
        pairs = meeting_pairs(leaf_a, leaf_b, nodes.p_from_q);
    else
        pairs = near_pairs(
            leaf_a, leaf_b, nodes.p_from_q,
            {bound_sq / nodes.p_from_q.stretch_sq * (1 + 0x1p-20F), bound_sq, nodes.n_p});
    // Lanes beyond the leaves' counts repeat the first triangle.
    constexpr std::uint32_t kRows[] = {0x000f, 0x00ff, 0x0fff, 0xffff};
    constexpr std::uint32_t kColumns[] = {0x1111, 0x3333, 0x7777, 0xffff};
    const std::uint32_t used = kRows[a.count() - 1] & kColumns[b.count() - 1];
    pairs.cross &= used;
    pairs.may_meet &= used;
    pairs.may_be_near &= used;
    return pairs;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
