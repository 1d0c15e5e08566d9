#include "rigid/pair/gap_search.h"

#include "core/stop.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// The boxes of a placed tree along the axes of a GapFrame. Both bounds are those of vertices, as they
/// are computed.
class GapBoxes {
public:
    GapBoxes(const ModelData& model, const Transform& world, const GapFrame& frame)
        : model_(model), world_(world), frame_(frame), copies_(model.slot_copies()),
          boxes_(model.tree().nodes.size() * Node::kWidth), root_(box_of_children(0)) {}

    [[nodiscard]] const Tree& tree() const { return model_.tree(); }
    [[nodiscard]] const Box3& box(std::uint32_t name) const {
        return name == kRootName ? root_ : boxes_[name];
    }
    /// Returns whether a triangle of a leaf is a copy of another one.
    [[nodiscard]] bool is_copy(NodeRef leaf, std::uint32_t i) const {
        return !copies_.empty() && copies_[leaf.first() + i];
    }
    /// Upper bound of the distance of a vertex from the frame's origin, but for rounding.
    [[nodiscard]] double reach() const {
        return length(
            max({std::abs(root_.lower.x), std::abs(root_.lower.y), std::abs(root_.lower.z)},
                {std::abs(root_.upper.x), std::abs(root_.upper.y), std::abs(root_.upper.z)}));
    }

private:
    Box3 box_of_children(std::uint32_t index) {
        poll_stop();
        const Node& node = tree().nodes[index];
        Box3 all;
        for (std::uint32_t lane = 0; lane < Node::kWidth && !node.child[lane].is_none(); ++lane) {
            const NodeRef child = node.child[lane];
            const Box3 box = child.is_leaf() ? box_of_leaf(child) : box_of_children(child.index());
            boxes_[child_name(index, lane)] = box;
            all = {min(all.lower, box.lower), max(all.upper, box.upper)};
        }
        return all;
    }
    [[nodiscard]] Box3 box_of_leaf(NodeRef leaf) const {
        Box3 box;
        for (std::uint32_t i = 0; i < leaf.count(); ++i)
            if (!is_copy(leaf, i))
                for (const Vec3& vertex : model_.world_slot(leaf.first() + i, world_))
                    extend(box, frame_.seen(vertex));
        return box;
    }

    const ModelData& model_;
    const Transform& world_;
    const GapFrame& frame_;
    const std::vector<bool>& copies_; ///< as ModelData::slot_copies
    std::vector<Box3> boxes_;         ///< by the names of children
    Box3 root_;
};

/// The distance of two boxes.
double gap_of(const Box3& a, const Box3& b) {
    const auto along = [](double low_a, double high_a, double low_b, double high_b) {
        return std::max({0.0, low_b - high_a, low_a - high_b});
    };
    return length({along(a.lower.x, a.upper.x, b.lower.x, b.upper.x),
                   along(a.lower.y, a.upper.y, b.lower.y, b.upper.y),
                   along(a.lower.z, a.upper.z, b.lower.z, b.upper.z)});
}

class GapSearch {
public:
    GapSearch(const PlacedPair& pair, const GapFrame& frame, PairTraversal& traversal,
              GapVisitor& visitor)
        : a_(pair.a(), pair.world_from_a(), frame), b_(pair.b(), pair.world_from_b(), frame),
          sizes_(a_.reach() + b_.reach()), traversal_(traversal), visitor_(visitor) {}

    Verdict run() {
        pending_.push_back({kRootName, kRootName, gap_of(a_.box(kRootName), b_.box(kRootName))});
        while (!pending_.empty()) {
            const BoxPair pair = pending_.back();
            if (visitor_.is_beyond(pair.gap, sizes_)) {
                pending_.pop_back();
                continue;
            }
            if (!traversal_.steps.take()) {
                leave();
                return Verdict::out_of_steps;
            }
            pending_.pop_back();
            const NodeRef a = a_.tree().named(pair.a), b = b_.tree().named(pair.b);
            if (a.is_leaf() && b.is_leaf()) {
                if (!visit(a, b, pair.gap))
                    return Verdict::stopped;
            } else if (opens_a(pair, a, b)) {
                open(a_, a, [&](std::uint32_t name) {
                    return BoxPair{name, pair.b, gap_of(a_.box(name), b_.box(pair.b))};
                });
            } else {
                open(b_, b, [&](std::uint32_t name) {
                    return BoxPair{pair.a, name, gap_of(a_.box(pair.a), b_.box(name))};
                });
            }
        }
        return Verdict::done;
    }

private:
    /// A pair of boxes that waits for its test, given by the boxes' names.
    struct BoxPair {
        std::uint32_t a, b;
        double gap;
    };

    [[nodiscard]] bool opens_a(const BoxPair& pair, NodeRef a, NodeRef b) const {
        const auto size_sq = [](const Box3& box) { return length_sq(box.upper - box.lower); };
        return !a.is_leaf() && (b.is_leaf() || size_sq(a_.box(pair.a)) >= size_sq(b_.box(pair.b)));
    }

    /// Adds the pairs of a node's children that are not beyond the bound, the nearest one last.
    template <typename PairOf>
    void open(const GapBoxes& side, NodeRef ref, const PairOf& pair_of) {
        const Node& node = side.tree().nodes[ref.index()];
        const auto before = static_cast<std::ptrdiff_t>(pending_.size());
        for (std::uint32_t lane = 0; lane < Node::kWidth && !node.child[lane].is_none(); ++lane) {
            const std::uint32_t name = child_name(ref.index(), lane);
            if (is_empty(side.box(name))) // only copies of triangles elsewhere
                continue;
            const BoxPair pair = pair_of(name);
            ++traversal_.volume_tests;
            if (!visitor_.is_beyond(pair.gap, sizes_))
                pending_.push_back(pair);
        }
        std::stable_sort(pending_.begin() + before, pending_.end(),
                         [](const BoxPair& p, const BoxPair& q) { return p.gap > q.gap; });
    }

    bool visit(NodeRef a, NodeRef b, double gap) {
        // All pairs of their triangles, as bits of LeafPairs, but for copies.
        std::uint32_t all = 0;
        for (std::uint32_t i = 0; i < a.count(); ++i)
            for (std::uint32_t j = 0; j < b.count(); ++j)
                if (!a_.is_copy(a, i) && !b_.is_copy(b, j)) {
                    all |= 1U << (TriangleLeaf::kLanes * i + j);
                    ++traversal_.primitive_tests;
                }
        LeafPairs pairs;
        (certain_gap(gap, sizes_) > 0 ? pairs.may_be_near : pairs.may_meet) = all;
        return visitor_.visit(a, b, pairs) >= 0;
    }

    /// Records the lower bounds of all pairs that are not visited.
    void leave() {
        for (const BoxPair& pair : pending_) {
            const double least = std::max(0.0, certain_gap(pair.gap, sizes_));
            traversal_.left_sq = std::min(traversal_.left_sq, least * least * (1 - 0x1p-50));
        }
    }

    GapBoxes a_, b_;
    double sizes_;
    PairTraversal& traversal_;
    GapVisitor& visitor_;
    boost::container::small_vector<BoxPair, 256> pending_;
};

} // namespace

Verdict search_gap(const PlacedPair& pair, const GapFrame& frame, PairTraversal& traversal,
                   GapVisitor& visitor) {
    if (pair.a().tree().empty() || pair.b().tree().empty())
        return Verdict::done;
    return GapSearch(pair, frame, traversal, visitor).run();
}

} // namespace abut
