#include "tree/outline.h"

#include "core/parallel.h"
#include "tree/orient.h"

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint32_t kNode = 5; ///< code of a child that is a node
constexpr unsigned kChildBits = 3;
constexpr std::uint32_t kChildMask = (1U << kChildBits) - 1;
constexpr std::uint32_t kOwnAxes = 1U << (kChildBits * Node::kWidth);
/// Upper limit on the depth. The builder's trees stay far below it, whatever the mesh.
constexpr std::size_t kDeepest = 1024;

std::uint32_t child_code(std::uint32_t node, std::size_t lane) {
    return node >> (kChildBits * lane) & kChildMask;
}

/// Walks the nodes depth first and calls take(node, lane, code, next), where `next` is the number
/// of a child that is a node. Returns false, before it reads out of bounds, if the nodes do not
/// form a tree.
template <typename Take>
bool walk(const std::vector<std::uint32_t>& nodes, const Take& take) {
    struct Place {
        std::uint32_t node;
        std::uint32_t lane;
    };
    std::vector<Place> path{{0, 0}};
    std::uint32_t next = 1;
    while (!path.empty()) {
        auto& [node, lane] = path.back();
        const std::uint32_t code = lane < Node::kWidth ? child_code(nodes[node], lane) : 0;
        if (code == 0) {
            path.pop_back();
            continue;
        }
        if (code > kNode || (code == kNode && (next == nodes.size() || path.size() == kDeepest)))
            return false;
        take(node, lane, code, next);
        ++lane;
        if (code == kNode)
            path.push_back({next++, 0});
    }
    return next == nodes.size();
}

/// Whether a node's children are contiguous and at least two. Only the root may have a single
/// child, which must be a leaf.
bool is_sound(std::uint32_t node, bool is_root) {
    std::size_t children = 0;
    while (children < Node::kWidth && child_code(node, children) != 0)
        ++children;
    return node >> (kChildBits * children) << (kChildBits * children) == (node & kOwnAxes) &&
           (children > 1 || (is_root && children == 1 && child_code(node, 0) != kNode));
}

/// Computes the boxes of all children in the tree's axes, from the leaves up.
void fit_boxes(Tree& tree) {
    const auto set_box = [](Node& node, std::size_t lane, const Aabb& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.lower[axis][lane] = box.lower[axis];
            node.upper[axis][lane] = box.upper[axis];
        }
    };
    parallel_for(tree.nodes.size(), 64, [&](std::size_t i) {
        Node& node = tree.nodes[i];
        for (std::size_t lane = 0; lane < Node::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            Aabb box;
            if (!child.is_none() && child.is_leaf())
                for (const auto& vertex : tree.leaf(child).v)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const auto [low, high] = std::minmax(
                            {vertex[axis][0], vertex[axis][1], vertex[axis][2], vertex[axis][3]});
                        box.lower[axis] = std::min(box.lower[axis], low);
                        box.upper[axis] = std::max(box.upper[axis], high);
                    }
            set_box(node, lane, box);
        }
    });
    const auto box_of = [](const Node& node) {
        Aabb all;
        for (std::size_t lane = 0; lane < Node::kWidth; ++lane)
            all.merge(node.box(lane));
        return all;
    };
    // Children come after their parent.
    for (std::size_t i = tree.nodes.size(); i-- > 0;)
        for (std::size_t lane = 0; lane < Node::kWidth; ++lane) {
            const NodeRef child = tree.nodes[i].child[lane];
            if (!child.is_none() && !child.is_leaf())
                set_box(tree.nodes[i], lane, box_of(tree.nodes[child.index()]));
        }
    tree.bounds = box_of(tree.nodes.front());
}

} // namespace

TreeOutline outline_of(const Tree& tree) {
    TreeOutline outline;
    outline.nodes.reserve(tree.nodes.size());
    outline.order.reserve(tree.order.size());
    for (const Node& node : tree.nodes) {
        std::uint32_t code = node.frame.turn == NodeFrame().turn ? 0 : kOwnAxes;
        for (std::size_t lane = 0; lane < Node::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_none())
                code |= (child.is_leaf() ? child.count() : kNode) << (kChildBits * lane);
        }
        outline.nodes.push_back(code);
    }
    if (!tree.empty())
        walk(outline.nodes, [&](std::uint32_t node, std::uint32_t lane, std::uint32_t code, auto) {
            const NodeRef child = tree.nodes[node].child[lane];
            for (std::uint32_t i = 0; code != kNode && i < code; ++i)
                outline.order.push_back(tree.order[child.first() + i]);
        });
    return outline;
}

bool is_outline(const TreeOutline& outline, std::size_t triangles) {
    const auto& [nodes, order] = outline;
    if (order.size() != triangles || nodes.empty() != order.empty())
        return false;
    if (nodes.empty())
        return true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!is_sound(nodes[i], i == 0))
            return false;
    std::size_t in_leaves = 0;
    if (!walk(nodes, [&](std::uint32_t, std::uint32_t, std::uint32_t code,
                         std::uint32_t) { in_leaves += code == kNode ? 0 : code; }) ||
        in_leaves != triangles)
        return false;
    std::vector<bool> is_there(triangles);
    for (const std::uint32_t triangle : order) {
        if (triangle >= triangles || is_there[triangle])
            return false;
        is_there[triangle] = true;
    }
    return true;
}

Tree build_tree(const TreeMesh& mesh, const TreeOutline& outline) {
    Tree tree;
    if (outline.nodes.empty())
        return tree;
    constexpr auto kLanes = static_cast<std::uint32_t>(TriangleLeaf::kLanes);
    tree.nodes.resize(outline.nodes.size());
    std::size_t leaves = 0;
    for (const std::uint32_t node : outline.nodes)
        for (std::size_t lane = 0; lane < Node::kWidth; ++lane)
            leaves += child_code(node, lane) % kNode != 0 ? 1 : 0;
    tree.order.reserve(kLanes * leaves);
    auto triangle = outline.order.begin();
    walk(outline.nodes,
         [&](std::uint32_t node, std::uint32_t lane, std::uint32_t code, std::uint32_t next) {
             NodeRef& child = tree.nodes[node].child[lane];
             if (code == kNode) {
                 child = NodeRef::node(next);
                 return;
             }
             child = NodeRef::leaf(static_cast<std::uint32_t>(tree.order.size()), code);
             for (std::uint32_t i = 0; i < kLanes; ++i) // unused lanes repeat the first
                 tree.order.push_back(triangle[i < code ? i : 0]);
             triangle += code;
         });
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        tree.nodes[i].frame.turned = (outline.nodes[i] & kOwnAxes) != 0;
    fill_leaves(tree, mesh);
    fit_boxes(tree);
    orient_nodes(tree, mesh, OwnAxes::where_turned);
    return tree;
}

} // namespace abut
