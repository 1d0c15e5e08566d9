#pragma once

#include "core/stop.h"
#include "geometry/leaf/point_leaf_distance.h"
#include "tree/obb_tree.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstdint>

/// Traversals of one tree: for a box, for a segment (in order, if wanted), and for the primitive
/// nearest to a point. The bodies follow the declarations.
namespace abut {

/// Calls visit(slot) for every primitive in a leaf whose box meets `query`.
template <typename Visit>
void for_each_overlap(const Tree& tree, const Aabb& query, const Visit& visit);

/// The points in front of a plane: normal . x > offset. The offset includes a margin for the errors
/// of both terms in the frame of any node.
struct TreeHalfSpace {
    std::array<float, 3> normal;
    float offset;
};
using TreeHalfSpaces = boost::container::static_vector<TreeHalfSpace, 16>;

/// As above, but skips leaves whose box lies in one of the half-spaces `but_for`. `visit` may add
/// half-spaces during the traversal.
template <typename Visit>
void for_each_overlap(const Tree& tree, const Aabb& query, const TreeHalfSpaces& but_for,
                      const Visit& visit);

/// A segment in a tree's frame, as midpoint and half vector, with a margin for the error of both.
struct TreeSegment {
    std::array<float, 3> middle, half;
    float margin; ///< at least the error of each coordinate in any node's frame, in the tree's
                  ///< units
};

/// Calls visit(slot) for every primitive whose leaf's box may meet the segment.
/// Source      separating axes of segment and box [Ericson 2005, 5.3.3].
template <typename Visit>
void for_each_on_segment(const Tree& tree, const TreeSegment& segment, const Visit& visit);

/// As above, but boxes that the segment enters first come first. `visit` returns the parameter s
/// beyond which no primitive matters any more; the segment is middle + s half, -1 <= s <= 1.
template <typename Visit>
void for_each_along_segment(const Tree& tree, const TreeSegment& segment, const Visit& visit);

/// Calls visit(slot) for primitives near a point, in order of their approximate distance in single
/// precision. `visit` returns the squared distance in the tree's frame beyond which no primitive
/// matters any more, or kStopTraversal.
template <typename Visit>
void for_each_near(const Tree& tree, const std::array<float, 3>& point, float margin,
                   float bound_sq, const Visit& visit);

namespace traverse_one {

using Hits = std::array<bool, Node::kWidth>;

/// The box in a node's frame that encloses a box of the tree's frame. If the frames are the same,
/// so are the boxes.
inline Aabb in_frame(const Aabb& box, const NodeFrame& frame) {
    Aabb result;
    for (std::size_t i = 0; i < 3; ++i) {
        float lower = 0, upper = 0, size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float a = frame.turn[k][i], low = box.lower[k] - frame.origin[k],
                        high = box.upper[k] - frame.origin[k];
            lower += a >= 0 ? a * low : a * high;
            upper += a >= 0 ? a * high : a * low;
            if (frame.turned)
                size +=
                    std::abs(box.lower[k]) + std::abs(box.upper[k]) + 2 * std::abs(frame.origin[k]);
        }
        result.lower[i] = lower - 0x1p-20F * size;
        result.upper[i] = upper + 0x1p-20F * size;
    }
    return result;
}

/// The primitives in a node's leaves that may be near a point.
class NearPrimitives {
public:
    void add(const Tree& tree, NodeRef leaf, const std::array<float, 3>& point, float margin,
             float bound_sq) {
        float lower_sq[TriangleLeaf::kLanes] = {};
        if (!tree.leaves.empty())
            point_leaf_distance_sq(tree.leaf(leaf), point, margin, lower_sq);
        for (std::uint32_t i = 0; i < leaf.count(); ++i)
            if (lower_sq[i] <= bound_sq)
                entries_.push_back({lower_sq[i], leaf.first() + i});
    }

    /// Visits the primitive that seems nearest first, then the others. Returns the bound that the
    /// last visit returned.
    template <typename Visit>
    float visit_all(float bound_sq, const Visit& visit) {
        const auto nearest =
            std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
                return a.distance_sq < b.distance_sq;
            });
        if (nearest != entries_.end())
            std::iter_swap(entries_.begin(), nearest);
        for (const Entry& entry : entries_)
            if (entry.distance_sq <= bound_sq)
                bound_sq = visit(entry.slot);
        return bound_sq;
    }

private:
    struct Entry {
        float distance_sq;
        std::uint32_t slot;
    };
    boost::container::static_vector<Entry, Node::kWidth * TriangleLeaf::kLanes> entries_;
};

/// Descends to every child that `test(node)` marks.
template <typename Test, typename Visit>
void descend(const Tree& tree, const Test& test, const Visit& visit) {
    if (tree.empty())
        return;
    boost::container::small_vector<std::uint32_t, 128> pending{0};
    SearchSteps steps;
    while (!pending.empty()) {
        steps.take();
        const Node& node = tree.nodes[pending.back()];
        pending.pop_back();
        const Hits hits = test(node);
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
            if (!hits[i])
                continue;
            const NodeRef child = node.child[i];
            if (!child.is_leaf())
                pending.push_back(child.index());
            else
                for (std::uint32_t slot = child.first(); slot < child.first() + child.count();
                     ++slot)
                    visit(slot);
        }
    }
}

/// For each child, the parameters at which a segment (middle + s half) enters it at the earliest
/// and leaves it at the latest. The segment misses a child that it leaves before it enters.
struct Passage {
    std::array<float, Node::kWidth> enter, leave;
};

/// Computes where the segment passes the children of a node.
/// Source      slabs [Kay, Kajiya 1986].
inline Passage pass(const Node& node, const TreeSegment& in_tree) {
    const TreeSegment segment{node.frame.point_from_tree(in_tree.middle),
                              node.frame.vector_from_tree(in_tree.half), in_tree.margin};
    // Several times the rounding error of a quotient near 1. The error of a larger quotient does
    // not change the result.
    constexpr float kRounding = 0x1p-20F;
    Passage passage{};
    passage.enter.fill(-1);
    passage.leave.fill(1);
    for (std::size_t k = 0; k < 3; ++k) {
        const float m = segment.middle[k], e = segment.half[k], inverse = 1 / e;
        const bool up = !std::signbit(e); // a zero has a sign too, and its inverse has the same
        const float* near = up ? node.lower[k] : node.upper[k];
        const float* far = up ? node.upper[k] : node.lower[k];
        const float to_near = up ? m + segment.margin : m - segment.margin,
                    to_far = up ? m - segment.margin : m + segment.margin;
        // Where e is 0, the quotient is infinite, or not a number in the plane of a face. In the
        // latter case std::max and std::min keep their first argument.
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            passage.enter[i] = std::max(passage.enter[i], (near[i] - to_near) * inverse);
            passage.leave[i] = std::min(passage.leave[i], (far[i] - to_far) * inverse);
        }
    }
    for (std::size_t i = 0; i < Node::kWidth; ++i)
        passage.enter[i] -= kRounding, passage.leave[i] += kRounding;
    return passage;
}

} // namespace traverse_one

namespace traverse_one {

inline Hits overlaps(const Node& node, const Aabb& query) {
    const Aabb q = in_frame(query, node.frame);
    Hits hits;
    for (std::size_t i = 0; i < Node::kWidth; ++i)
        hits[i] = bool((node.lower[0][i] <= q.upper[0]) & (q.lower[0] <= node.upper[0][i]) &
                       (node.lower[1][i] <= q.upper[1]) & (q.lower[1] <= node.upper[1][i]) &
                       (node.lower[2][i] <= q.upper[2]) & (q.lower[2] <= node.upper[2][i]));
    return hits;
}

/// Unmarks the children that lie in the half-space.
inline void take_out(const Node& node, const TreeHalfSpace& space, Hits& hits) {
    const std::array<float, 3> n = node.frame.vector_from_tree(space.normal);
    const auto& o = node.frame.origin;
    const float offset =
        space.offset - space.normal[0] * o[0] - space.normal[1] * o[1] - space.normal[2] * o[2];
    for (std::size_t i = 0; i < Node::kWidth; ++i) {
        float least = 0;
        for (std::size_t k = 0; k < 3; ++k)
            least += std::min(n[k] * node.lower[k][i], n[k] * node.upper[k][i]);
        hits[i] = bool(hits[i] & !(least > offset));
    }
}

} // namespace traverse_one

template <typename Visit>
void for_each_overlap(const Tree& tree, const Aabb& query, const Visit& visit) {
    traverse_one::descend(
        tree, [&](const Node& node) { return traverse_one::overlaps(node, query); }, visit);
}

template <typename Visit>
void for_each_overlap(const Tree& tree, const Aabb& query, const TreeHalfSpaces& but_for,
                      const Visit& visit) {
    const auto test = [&](const Node& node) {
        traverse_one::Hits hits = traverse_one::overlaps(node, query);
        for (const TreeHalfSpace& space : but_for)
            traverse_one::take_out(node, space, hits);
        return hits;
    };
    traverse_one::descend(tree, test, visit);
}

template <typename Visit>
void for_each_on_segment(const Tree& tree, const TreeSegment& segment, const Visit& visit) {
    const auto test = [&](const Node& node) {
        const std::array<float, 3> m = node.frame.point_from_tree(segment.middle),
                                   e = node.frame.vector_from_tree(segment.half);
        const std::array<float, 3> reach{std::abs(e[0]), std::abs(e[1]), std::abs(e[2])};
        traverse_one::Hits hits;
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            std::array<float, 3> c{}, h{};
            for (std::size_t k = 0; k < 3; ++k) {
                c[k] = m[k] - 0.5F * (node.lower[k][i] + node.upper[k][i]);
                h[k] = 0.5F * (node.upper[k][i] - node.lower[k][i]) + segment.margin;
            }
            // The axes of the box, then the cross products of the segment with these axes. The
            // rounding of the latter's products is relative to the products and to the box, and the
            // margin in h exceeds it.
            bool hit = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
                hit = bool(
                    hit & (std::abs(c[k]) <= h[k] + reach[k]) &
                    (std::abs(c[u] * e[v] - c[v] * e[u]) <= h[u] * reach[v] + h[v] * reach[u]));
            }
            hits[i] = hit;
        }
        return hits;
    };
    traverse_one::descend(tree, test, visit);
}

template <typename Visit>
void for_each_along_segment(const Tree& tree, const TreeSegment& segment, const Visit& visit) {
    struct Entry {
        float enter = -1;
        NodeRef ref;
    };
    if (tree.empty())
        return;
    float bound = 1;
    boost::container::small_vector<Entry, 128> pending{{-1, NodeRef::node(0)}};
    SearchSteps steps;
    while (!pending.empty()) {
        steps.take();
        const Entry entry = pending.back();
        pending.pop_back();
        if (entry.enter > bound)
            continue;
        if (entry.ref.is_leaf()) {
            for (std::uint32_t slot = entry.ref.first();
                 slot < entry.ref.first() + entry.ref.count(); ++slot)
                bound = visit(slot);
            continue;
        }
        const Node& node = tree.nodes[entry.ref.index()];
        const traverse_one::Passage passage = traverse_one::pass(node, segment);
        // The child that is entered first goes on top of the stack.
        const auto first = static_cast<std::ptrdiff_t>(pending.size());
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            if (passage.enter[i] <= std::min(passage.leave[i], bound))
                pending.push_back({passage.enter[i], node.child[i]});
        std::sort(pending.begin() + first, pending.end(),
                  [](const Entry& a, const Entry& b) { return a.enter > b.enter; });
    }
}

template <typename Visit>
void for_each_near(const Tree& tree, const std::array<float, 3>& point, float margin,
                   float bound_sq, const Visit& visit) {
    struct Entry {
        float distance_sq = 0;
        std::uint32_t node = 0;
        bool operator<(const Entry& other) const { return distance_sq > other.distance_sq; }
    };
    if (tree.empty())
        return;
    boost::container::small_vector<Entry, 128> heap{{0, 0}};
    SearchSteps steps;
    while (!heap.empty() && heap.front().distance_sq <= bound_sq) {
        steps.take();
        std::pop_heap(heap.begin(), heap.end());
        const Node& node = tree.nodes[heap.back().node];
        heap.pop_back();
        const std::array<float, 3> p = node.frame.point_from_tree(point);
        std::array<float, Node::kWidth> distance_sq{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < Node::kWidth; ++i) {
                const float gap = std::max(
                    0.0F, std::max(node.lower[k][i] - p[k], p[k] - node.upper[k][i]) - margin);
                distance_sq[i] += gap * gap;
            }
        traverse_one::NearPrimitives near;
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
            const NodeRef child = node.child[i];
            if (!(distance_sq[i] <= bound_sq))
                continue;
            if (child.is_leaf()) {
                near.add(tree, child, p, margin, bound_sq);
            } else {
                heap.push_back({distance_sq[i], child.index()});
                std::push_heap(heap.begin(), heap.end());
            }
        }
        bound_sq = near.visit_all(bound_sq, visit);
    }
}

} // namespace abut
