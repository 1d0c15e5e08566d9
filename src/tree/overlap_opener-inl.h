// Opens pairs of nodes of moving trees: one box against the eight children of a node in SIMD.

// Included once for each target.
#if defined(ABUT_TREE_OVERLAP_OPENER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_TREE_OVERLAP_OPENER_INL_H
#undef ABUT_TREE_OVERLAP_OPENER_INL_H
#else
#define ABUT_TREE_OVERLAP_OPENER_INL_H
#endif

#include "tree/traverse_overlaps.h"
#include "volume/moving_box-inl.h"

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Replaces a pair that is not two leaves by pairs of children that may overlap. It hands these to
/// a Pending:
///
///     void add_self(std::uint32_t name);  // a child with itself
///     /// Adds pair_of(lane) for the lanes of `wanted` in which the node's child may overlap the box.
///     void add_near(const MovingNode& node, const MovingBoxRef& box, std::uint32_t wanted, pair_of);
template <typename Pending>
class OverlapOpener {
public:
    OverlapOpener(const OverlapTraversal& traversal, Pending& pending)
        : traversal_(traversal), pending_(pending) {}

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
    /// The box of a child. In: not the root's name.
    static MovingBoxRef box_of(const MovingTree& tree, std::uint32_t name) {
        return {tree.nodes[node_of(name)].boxes(), lane_of(name)};
    }

    void open_self(std::uint32_t node) {
        if (!traversal_.skipped.empty() && traversal_.skipped[node] != 0)
            return;
        for_each_child(traversal_.a, node, [&](std::uint32_t name, std::uint32_t lane) {
            pending_.add_self(name);
            open_b(name, node, 0xfeU << lane);
        });
    }
    /// Pairs a child of a with those children of a node of b that are `wanted`.
    void open_b(std::uint32_t name, std::uint32_t node, std::uint32_t wanted) {
        pending_.add_near(traversal_.b.nodes[node], box_of(traversal_.a, name), wanted,
                          [&](std::uint32_t lane) {
                              return OverlapTraversal::Pair{name, child_name(node, lane)};
                          });
    }
    void open_a(std::uint32_t node, std::uint32_t name) {
        pending_.add_near(traversal_.a.nodes[node], box_of(traversal_.b, name), 0xffU,
                          [&](std::uint32_t lane) {
                              return OverlapTraversal::Pair{child_name(node, lane), name};
                          });
    }

    const OverlapTraversal& traversal_;
    Pending& pending_;
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
