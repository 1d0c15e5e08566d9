#pragma once

#include <abut/types.h>

#include "geometry/leaf/triangle_leaf.h"
#include "volume/aabb.h"

#include <array>
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

/// The frame of a node: x_node = sum over k of turn[k] (x_tree - origin)[k]. Its axes are
/// orthogonal and of unit length to single precision.
struct alignas(16) NodeFrame {
    /// The tree's axes in the node's frame: the columns of the rotation, padded to four.
    std::array<std::array<float, 4>, 3> turn{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    std::array<float, 3> origin{};
    bool turned = false; ///< false: axes and origin are the tree's

    [[nodiscard]] std::array<float, 3> vector_from_tree(const std::array<float, 3>& v) const {
        std::array<float, 3> r{};
        for (std::size_t i = 0; i < 3; ++i)
            r[i] = turn[0][i] * v[0] + turn[1][i] * v[1] + turn[2][i] * v[2];
        return r;
    }
    [[nodiscard]] std::array<float, 3> point_from_tree(const std::array<float, 3>& p) const {
        return vector_from_tree({p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]});
    }
    [[nodiscard]] Vec3 point_from_tree(const Vec3& p) const {
        const double x = p.x - double{origin[0]}, y = p.y - double{origin[1]},
                     z = p.z - double{origin[2]};
        const auto along = [&](std::size_t i) {
            return double{turn[0][i]} * x + double{turn[1][i]} * y + double{turn[2][i]} * z;
        };
        return {along(0), along(1), along(2)};
    }
    /// The inverse map. It is accurate only to single precision, as the axes are orthogonal only to
    /// that.
    [[nodiscard]] Vec3 point_to_tree(const Vec3& p) const {
        const auto along = [&](std::size_t k) {
            return double{turn[k][0]} * p.x + double{turn[k][1]} * p.y + double{turn[k][2]} * p.z +
                   double{origin[k]};
        };
        return {along(0), along(1), along(2)};
    }
};

/// A node with eight children: lane i of every row belongs to child i. Unused lanes come last.
/// Their boxes are empty (lower > upper) and their references are none. The boxes are aligned to
/// the node's own frame.
struct alignas(32) Node {
    static constexpr std::size_t kWidth = 8;
    float lower[3][kWidth]; ///< [axis][child]
    float upper[3][kWidth];
    NodeRef child[kWidth];
    NodeFrame frame;
    Aabb bounds;     ///< of all children
    float reach = 0; ///< the largest magnitude of a child's coordinates

    [[nodiscard]] Aabb box(std::size_t i) const {
        Aabb b;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            b.lower[axis] = lower[axis][i];
            b.upper[axis] = upper[axis][i];
        }
        return b;
    }
};

/// The name of a child: its node and its lane there in one number. The root, which is no child, has
/// a name of its own.
constexpr std::uint32_t kRootName = 0xffffffffU;
constexpr std::uint32_t child_name(std::uint32_t node, std::uint32_t lane) {
    return node * static_cast<std::uint32_t>(Node::kWidth) + lane;
}
/// The node that holds the child. In: not kRootName.
constexpr std::uint32_t node_of(std::uint32_t name) {
    return name / Node::kWidth;
}
constexpr std::uint32_t lane_of(std::uint32_t name) {
    return name % Node::kWidth;
}

/// Bounding-volume hierarchy over boxes or triangles, eight wide. Immutable once built.
struct Tree {
    std::vector<Node> nodes;          ///< nodes[0] is the root; empty if there is no primitive
    std::vector<std::uint32_t> order; ///< slot -> primitive; a leaf is a run of slots
    Aabb bounds;                      ///< of all primitives, in the tree's frame
    /// Only for a tree of triangles. The leaf with first slot s is leaves[s / 4], in the frame of
    /// its node.
    std::vector<TriangleLeaf> leaves;

    [[nodiscard]] bool empty() const { return nodes.empty(); }
    [[nodiscard]] NodeRef named(std::uint32_t name) const {
        return name == kRootName ? NodeRef::node(0) : nodes[node_of(name)].child[lane_of(name)];
    }
    [[nodiscard]] const TriangleLeaf& leaf(NodeRef ref) const {
        return leaves[ref.first() / TriangleLeaf::kLanes];
    }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(Node) + order.size() * sizeof(order[0]) +
               leaves.size() * sizeof(TriangleLeaf);
    }
};

/// Builds the tree of some boxes. Every node has the tree's axes.
///
/// In          fewer than 2^28 boxes, none empty, all finite.
/// Cost        O(n log n); subtrees in parallel. The result does not depend on the number of
///             threads.
/// Source      binned surface-area heuristic [Wald 2007]; wide nodes by opening the largest child
///             first. Differs: small sets are cut at multiples of 4, then of 32, so that leaves and
///             nodes are full.
Tree build_tree(std::span<const Aabb> boxes);

/// The mesh over which a tree is built, in the tree's frame.
struct TreeMesh {
    std::span<const Vec3> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Builds the tree of some triangles. A node has its own axes if they make its children's boxes
/// smaller.
///
/// In          fewer than 2^28 triangles; `own_axes` false: all nodes have the tree's axes.
/// Source      orientation by the covariance of the surface [Gottschalk, Lin, Manocha 1996].
///             Differs: one orientation for all eight children, so that its cost is paid once for
///             up to 64 pairs of boxes; covariance of the triangles, not of their hull.
Tree build_tree(const TreeMesh& mesh, bool own_axes = true);

/// Throws std::logic_error if a box does not enclose what lies below it, or if a primitive is not
/// in exactly one leaf.
void validate(const Tree& tree, std::span<const Aabb> boxes);
void validate(const Tree& tree, const TreeMesh& mesh);

} // namespace abut
