#include "tree/traverse_volumes.h"

#include "core/set_bits.h"
#include "tree/near_first_queue.h"

#include <algorithm>
#include <bit>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/traverse_volumes.cpp"
#include "simd/foreach_target.h"
#include "tree/node_pair-inl.h"
#include "volume/lower_bound-inl.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_TRAVERSE_VOLUMES_ONCE
#define ABUT_TREE_TRAVERSE_VOLUMES_ONCE
namespace abut::traverse_volumes {

/// Exceeds what underflow takes from a product. Without it, an underflowed product of 0 would make
/// every pair count as within a bound that is nearly 0.
constexpr float kUnderflow = std::numeric_limits<float>::min();

/// A pair of volumes that waits for its test, given by the volumes' names.
struct VolumePair {
    std::uint32_t a, b;
    float bound_sq; ///< lower bound of the squared distance
};
using VolumePairs = boost::container::small_vector<VolumePair, 512>;

/// The volumes of a tree, all of one kind.
template <typename V>
class PureLayer {
public:
    using Volume = V;

    explicit PureLayer(const VolumeTree& tree) : layer_(std::get<VolumeLayer<V>>(tree.layer())) {}

    [[nodiscard]] const V& root() const { return layer_.root; }
    [[nodiscard]] const VolumeBatch<V>& children(std::uint32_t node) const {
        return layer_.children[node];
    }
    [[nodiscard]] V child(std::uint32_t node, std::uint32_t lane) const {
        return children(node).get(lane);
    }

private:
    const VolumeLayer<V>& layer_;
};

/// The swept spheres of a tree, of any kind. Each is handed out as an Ssv.
class SweptLayer {
public:
    using Volume = Ssv;

    explicit SweptLayer(const VolumeTree& tree) {
        std::visit([this](const auto& layer) { take(layer); }, tree.layer());
    }

    [[nodiscard]] const Ssv& root() const { return root_; }
    [[nodiscard]] SweptBatch children(std::uint32_t node) const {
        return {batches_ + std::size_t{node} * rows_, (rows_ - 4) / 4};
    }
    [[nodiscard]] Ssv child(std::uint32_t node, std::uint32_t lane) const {
        const auto* row = batches_ + std::size_t{node} * rows_;
        const auto vector = [&](std::size_t first) {
            return std::array{row[first][lane], row[first + 1][lane], row[first + 2][lane]};
        };
        Ssv swept;
        swept.centre = vector(0);
        swept.radius = row[3][lane];
        for (std::size_t i = 0; 4 + 4 * i < rows_; ++i)
            swept.axes[i] = {vector(4 + 4 * i), row[4 + 4 * i + 3][lane]};
        return swept;
    }

private:
    template <typename V>
    void take(const VolumeLayer<V>& layer) {
        if constexpr (std::is_constructible_v<Ssv, V>) {
            static_assert(sizeof(layer.children[0]) == sizeof(layer.children[0].row));
            root_ = Ssv(layer.root);
            batches_ = layer.children.empty() ? nullptr : layer.children[0].row;
            rows_ = V::kFloats;
        }
    }

    const float (*batches_)[VolumeBounds::kLanes] = nullptr;
    std::size_t rows_ = 4; ///< of a batch
    Ssv root_;
};

/// One side of the pair, with the map that brings the other side's volumes into its frame.
template <class Layer>
struct Side {
    using Volume = typename Layer::Volume;

    const Tree& tree;
    Layer layer;
    typename Volume::Map from_other;
    float stretch_sq, most_stretch_sq; ///< from squared distances in its frame to those in the
                                       ///< world

    [[nodiscard]] Volume volume(std::uint32_t name) const {
        return name == kRootName ? layer.root() : layer.child(node_of(name), lane_of(name));
    }
};

/// A bit for each child that a node has.
inline std::uint32_t children_of(const Node& node) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < Node::kWidth; ++i)
        bits |= node.child[i].is_none() ? 0U : 1U << i;
    return bits;
}

} // namespace abut::traverse_volumes
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

using traverse_volumes::PureLayer;
using traverse_volumes::Side;
using traverse_volumes::SweptLayer;
using traverse_volumes::VolumePair;
using traverse_volumes::VolumePairs;

/// A traversal of two trees with volumes that can be compared.
template <class Layer>
class Traversal {
    using V = typename Layer::Volume;

public:
    Traversal(const VolumeTraversal& t, LeafPairVisitor& visitor)
        : pair_(t.pair),
          visitor_(visitor), a_{t.pair.a, Layer(t.volumes_a), typename V::Map(t.frame.a_from_b),
                                t.frame.stretch_a_sq, t.frame.most_stretch_a_sq},
          b_{t.pair.b, Layer(t.volumes_b), typename V::Map(t.frame.b_from_a), t.frame.stretch_b_sq,
             t.frame.most_stretch_b_sq},
          bound_sq_(round_up(t.pair.bound_sq)) {}

    template <bool with_upper>
    Verdict depth_first() {
        contacts_only_ = !with_upper;
        VolumePairs pending;
        pending.push_back({kRootName, kRootName, 0});
        while (!pending.empty()) {
            if (!pair_.steps.take())
                return Verdict::out_of_steps;
            const VolumePair pair = pending.back();
            pending.pop_back();
            if (pair.bound_sq > bound_sq_)
                continue;
            if (const Verdict verdict = step<with_upper>(pair, pending); verdict != Verdict::done)
                return verdict;
        }
        return Verdict::done;
    }

    Verdict best_first() {
        // The circumscribed balls of the roots bound the distance of any two points.
        VolumeBounds bounds{};
        bound_all<true>(D(), root_batch(), image_of(b_.layer.root(), a_.from_other), bounds);
        NearFirstQueue<VolumePair> pending(
            std::min(bound_sq_, bounds.upper_sq[0] * a_.most_stretch_sq));
        pending.push(0, {kRootName, kRootName, 0});
        VolumePairs found;
        while (!pending.empty() && !pending.all_above(bound_sq_)) {
            if (!pair_.steps.take()) {
                while (!pending.empty())
                    pair_.leave(pending.pop().bound_sq);
                return Verdict::out_of_steps;
            }
            const VolumePair pair = pending.pop();
            if (pair.bound_sq > bound_sq_)
                continue;
            found.clear();
            if (const Verdict verdict = step<false>(pair, found); verdict != Verdict::done)
                return verdict;
            for (const VolumePair& child : found)
                pending.push(child.bound_sq, child);
        }
        return Verdict::done;
    }

private:
    using D = hn::CappedTag<float, VolumeBounds::kLanes>;

    [[nodiscard]] VolumeBatch<V> root_batch() const {
        VolumeBatch<V> batch;
        batch.set(0, a_.layer.root());
        return batch;
    }

    /// Visits a pair of leaves, or adds the children of another pair to `found`. Any verdict but
    /// `done` ends the traversal.
    template <bool with_upper>
    HWY_INLINE Verdict step(const VolumePair& pair, VolumePairs& found) {
        const NodeRef ref_a = a_.tree.named(pair.a), ref_b = b_.tree.named(pair.b);
        if (ref_a.is_leaf() && ref_b.is_leaf()) {
            return visit(ref_a, leaf_node(a_, pair.a), ref_b, leaf_node(b_, pair.b));
        }
        const V volume_a = a_.volume(pair.a), volume_b = b_.volume(pair.b);
        const auto size = [](const V& volume, const Side<Layer>& side) {
            const float r = volume.circumradius();
            return r * r * side.most_stretch_sq;
        };
        const bool open_a =
            !ref_a.is_leaf() && (ref_b.is_leaf() || size(volume_a, a_) > size(volume_b, b_));
        const bool accepted =
            open_a ? open<with_upper>(a_, ref_a.index(), volume_b,
                                      [&](auto child, float bound_sq) {
                                          found.push_back({child, pair.b, bound_sq});
                                      })
                   : open<with_upper>(b_, ref_b.index(), volume_a, [&](auto child, float bound_sq) {
                         found.push_back({pair.a, child, bound_sq});
                     });
        return accepted ? Verdict::accepted : Verdict::done;
    }

    /// The node that a leaf is a child of.
    static const Node& leaf_node(const Side<Layer>& side, std::uint32_t name) {
        return side.tree.nodes[node_of(name)];
    }
    Verdict visit(NodeRef a, const Node& p, NodeRef b, const Node& q) {
        pair_.primitive_tests += std::uint64_t{a.count()} * b.count();
        const NodePair nodes(pair_.frame, p, q);
        const LeafPairs pairs =
            compare_leaves(pair_.a, a, pair_.b, b, nodes, contacts_only_, bound_sq_);
        if (pairs.any() == 0)
            return Verdict::done;
        const double bound_sq = visitor_.visit(a, b, pairs);
        bound_sq_ = round_up(bound_sq);
        return bound_sq >= 0 ? Verdict::done : Verdict::stopped;
    }

    /// Compares one volume of the other tree with the children of a node, and adds the children
    /// that may be within the bound. Returns true if one lies wholly within the bound.
    template <bool with_upper, typename Add>
    HWY_INLINE bool open(const Side<Layer>& side, std::uint32_t index, const V& other,
                         const Add& add) {
        VolumeBounds bounds{};
        bound_all<with_upper>(D(), side.layer.children(index), image_of(other, side.from_other),
                              bounds);
        const std::uint32_t used = traverse_volumes::children_of(side.tree.nodes[index]);
        pair_.volume_tests += static_cast<std::uint64_t>(std::popcount(used));
        // The child that overlaps deepest goes last, so that it is tested next: a contact is
        // likeliest there.
        std::uint32_t deepest = Node::kWidth;
        for (std::uint32_t lane : SetBits(used)) {
            constexpr float kUnderflow = traverse_volumes::kUnderflow;
            if (with_upper &&
                (bounds.upper_sq[lane] + kUnderflow) * side.most_stretch_sq + kUnderflow <=
                    bound_sq_)
                return true;
            bounds.lower_sq[lane] *= side.stretch_sq;
            // A bound that is not a number keeps the child.
            if (bounds.lower_sq[lane] > bound_sq_)
                continue;
            if (deepest == Node::kWidth || bounds.gap[lane] < bounds.gap[deepest])
                std::swap(lane, deepest);
            if (lane != Node::kWidth)
                add(child_name(index, lane), bounds.lower_sq[lane]);
        }
        if (deepest != Node::kWidth)
            add(child_name(index, deepest), bounds.lower_sq[deepest]);
        return false;
    }

    PairTraversal& pair_;
    LeafPairVisitor& visitor_;
    Side<Layer> a_, b_;
    float bound_sq_;
    bool contacts_only_ = false;
};

/// Calls run(traversal) with the traversal that compares the kinds of both trees.
template <class Run>
Verdict with_traversal(const VolumeTraversal& t, LeafPairVisitor& visitor, const Run& run) {
    const auto mixed = [&]() HWY_ATTR { return run(Traversal<SweptLayer>(t, visitor)); };
    if (t.volumes_a.kind() != t.volumes_b.kind())
        return mixed();
    return std::visit(
        [&]<typename V>(const VolumeLayer<V>&) HWY_ATTR {
            if constexpr (std::is_same_v<V, Ssv>)
                return mixed();
            else
                return run(Traversal<PureLayer<V>>(t, visitor));
        },
        t.volumes_a.layer());
}

} // namespace abut::HWY_NAMESPACE::volumes

namespace abut::HWY_NAMESPACE {

Verdict volume_contacts(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return volumes::with_traversal(t, visitor, [](auto&& traversal) HWY_ATTR {
        return traversal.template depth_first<false>();
    });
}
Verdict volumes_within(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return volumes::with_traversal(t, visitor, [](auto&& traversal) HWY_ATTR {
        return traversal.template depth_first<true>();
    });
}
Verdict nearest_volumes(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return volumes::with_traversal(
        t, visitor, [](auto&& traversal) HWY_ATTR { return traversal.best_first(); });
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(volume_contacts);
HWY_EXPORT(volumes_within);
HWY_EXPORT(nearest_volumes);

namespace {

/// Returns whether a traversal compares the volumes of these kinds.
bool can_compare(Volume a, Volume b) {
    const Volume common = common_volume(a, b);
    return common != Volume::automatic && common != Volume::aabb;
}

} // namespace

VolumeFrame make_volume_frame(const VolumeTree& a, const Transform& world_from_a,
                              const VolumeTree& b, const Transform& world_from_b) {
    VolumeFrame frame;
    const auto [least_a, most_a] = stretch_of(world_from_a);
    const auto [least_b, most_b] = stretch_of(world_from_b);
    const auto origin = [](const Transform& t) { return length({t.m[9], t.m[10], t.m[11]}); };
    const double world_size =
        origin(world_from_a) + most_a * a.reach() + origin(world_from_b) + most_b * b.reach();
    // Bounds the rounding of double precision in the composed transforms and the world positions.
    const double slack = 128 * 0x1p-53 * world_size;
    frame.a_from_b = make_relative_pose(compose(inverse(world_from_a), world_from_b), a.reach(),
                                        b.reach(), slack / least_a);
    frame.b_from_a = make_relative_pose(compose(inverse(world_from_b), world_from_a), b.reach(),
                                        a.reach(), slack / least_b);
    // Products with these factors are rounded once more.
    frame.stretch_a_sq = round_down(least_a * least_a * (1 - 8 * 0x1p-24));
    frame.stretch_b_sq = round_down(least_b * least_b * (1 - 8 * 0x1p-24));
    frame.most_stretch_a_sq = round_up(most_a * most_a * (1 + 8 * 0x1p-24));
    frame.most_stretch_b_sq = round_up(most_b * most_b * (1 + 8 * 0x1p-24));
    frame.valid = can_compare(a.kind(), b.kind()) && frame.a_from_b.valid && frame.b_from_a.valid &&
                  std::isfinite(frame.most_stretch_a_sq) &&
                  std::isfinite(frame.most_stretch_b_sq) && frame.stretch_a_sq > 0x1p-100F &&
                  frame.stretch_b_sq > 0x1p-100F;
    return frame;
}

Verdict traverse_contacts(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return HWY_DYNAMIC_DISPATCH(volume_contacts)(t, visitor);
}
Verdict traverse_within(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return HWY_DYNAMIC_DISPATCH(volumes_within)(t, visitor);
}
Verdict traverse_nearest(const VolumeTraversal& t, LeafPairVisitor& visitor) {
    return HWY_DYNAMIC_DISPATCH(nearest_volumes)(t, visitor);
}

} // namespace abut
#endif
