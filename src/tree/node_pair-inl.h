// Two nodes of two trees to each other, and their leaves: what every traversal of a pair ends in.

// Included once for each target.
#if defined(ABUT_TREE_NODE_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_TREE_NODE_PAIR_INL_H
#undef ABUT_TREE_NODE_PAIR_INL_H
#else
#define ABUT_TREE_NODE_PAIR_INL_H
#endif

#include "simd/simd.h"
#include "tree/pair_frame.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

// x_to = A_to (M (A_from^T x_from + o_from) + t - o_to), A the nodes' rotations. What the origins
// cancel is computed in double, so that the error is relative to the nodes and their distance.
HWY_INLINE void between_nodes(const TreeMap& trees, const Node& to, const Node& from,
                              FrameMap& map) {
    float turned[3][4]; // M A_from^T
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            turned[i][k] = trees.linear[i][0] * from.frame.turn[0][k] +
                           trees.linear[i][1] * from.frame.turn[1][k] +
                           trees.linear[i][2] * from.frame.turn[2][k];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            map.linear[i][k] = to.frame.turn[0][i] * turned[0][k] +
                               to.frame.turn[1][i] * turned[1][k] +
                               to.frame.turn[2][i] * turned[2][k];
            map.magnitude[i][k] = std::abs(map.linear[i][k]);
        }
    const auto& m = trees.to_from.m;
    const std::array<double, 3> o{from.frame.origin[0], from.frame.origin[1], from.frame.origin[2]};
    float d[3];
    for (std::size_t i = 0; i < 3; ++i)
        d[i] = static_cast<float>(m[i] * o[0] + m[3 + i] * o[1] + m[6 + i] * o[2] + m[9 + i] -
                                  double{to.frame.origin[i]});
    map.translation = to.frame.vector_from_tree({d[0], d[1], d[2]});
    const float size = to.reach + 2 * trees.row_sum * from.reach +
                       2 * (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
    map.margin = 24 * 0x1p-24F * size + trees.margin;
    map.stretch_sq = trees.stretch_sq;
    map.most_stretch_sq = trees.most_stretch_sq;
}

/// Two nodes to each other, p of a and q of b.
struct NodePair {
    FrameMap p_from_q, q_from_p;
    Covector n_p{}, n_q{}; ///< the direction, from a to b

    HWY_INLINE NodePair(const PairFrame& frame, const Node& p, const Node& q) {
        between_nodes(frame.a_from_b, p, q, p_from_q);
        between_nodes(frame.b_from_a, q, p, q_from_p);
    }
};

/// The pairs of triangles of two leaves, children of the nodes, that may meet; and those that may be
/// within the bound (squared, in the world), unless only contacts matter.
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
    // Lanes beyond the leaves' counts repeat the first.
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
