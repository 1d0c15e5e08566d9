#pragma once

#include "volume/aabb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Reference to a node, or to a leaf's run of primitives.
///
///     bit  31      30..3          2..0
///          leaf?   first slot     count - 1       (leaf)
///          0       node index                      (node)
class NodeRef {
public:
    static NodeRef node(std::uint32_t index) { return NodeRef(index); }
    static NodeRef leaf(std::uint32_t first, std::uint32_t count) {
        return NodeRef(0x80000000U | first << 3 | (count - 1));
    }
    static NodeRef none() { return NodeRef(0xffffffffU); }

    NodeRef() = default;
    [[nodiscard]] bool is_none() const { return bits_ == 0xffffffffU; }
    [[nodiscard]] bool is_leaf() const { return (bits_ & 0x80000000U) != 0; }
    [[nodiscard]] std::uint32_t index() const { return bits_; }
    [[nodiscard]] std::uint32_t first() const { return (bits_ & 0x7fffffffU) >> 3; }
    [[nodiscard]] std::uint32_t count() const { return (bits_ & 7U) + 1; }

private:
    explicit NodeRef(std::uint32_t bits) : bits_(bits) {}
    std::uint32_t bits_ = 0xffffffffU;
};

/// Eight children side by side: lane i of every row belongs to child i. Unused lanes come last:
/// their box is empty (lower > upper), their reference none.
struct alignas(32) Node {
    static constexpr std::size_t kWidth = 8;
    float lower[3][kWidth]; ///< [axis][child]
    float upper[3][kWidth];
    NodeRef child[kWidth];

    [[nodiscard]] Aabb box(std::size_t i) const {
        Aabb b;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            b.lower[axis] = lower[axis][i];
            b.upper[axis] = upper[axis][i];
        }
        return b;
    }
};

/// Bounding-volume hierarchy over boxes, eight wide. Immutable once built.
struct Tree {
    std::vector<Node> nodes;          ///< nodes[0] is the root; empty if there is no primitive
    std::vector<std::uint32_t> order; ///< slot -> primitive; a leaf is a run of slots
    Aabb bounds;                      ///< of all primitives

    [[nodiscard]] bool empty() const { return nodes.empty(); }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(Node) + order.size() * sizeof(order[0]);
    }
};

struct TreeOptions {
    std::uint32_t leaf_size = 4; ///< primitives in a leaf, at most; 1 to 8
};

/// Builds the tree of some boxes.
///
/// In          fewer than 2^28 boxes, none empty, all finite.
/// Cost        O(n log n); subtrees in parallel. The result does not depend on the number of
///             threads.
/// Source      binned surface-area heuristic [Wald 2007]; wide nodes by opening the largest child
///             first.
Tree build_tree(std::span<const Aabb> boxes, const TreeOptions& options = {});

/// Throws std::logic_error if a box fails to enclose what lies below it, or a slot is not in
/// exactly one leaf.
void validate(const Tree& tree, std::span<const Aabb> boxes);

} // namespace abut
