#include "core/parallel.h"
#include "math/rounding.h"
#include "math/vector.h"
#include "tree/obb_tree.h"
#include "tree/orient.h"

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <limits>
#include <mutex>
#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/build.cpp"
#include "simd/foreach_target.h"
#include "simd/simd.h"

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_BUILD_ONCE
#define ABUT_TREE_BUILD_ONCE
namespace abut::build_tree_detail {

constexpr std::uint32_t kLeafSize = TriangleLeaf::kLanes;
constexpr std::uint32_t kBottomSize = kLeafSize * Node::kWidth; ///< primitives of a node whose
                                                                ///< leaves are all full
constexpr std::size_t kBins = 16;
constexpr std::uint32_t kParallelSplit =
    4096; // with fewer primitives, a task costs more than it saves

/// Four floats. The fourth is padding, except in Primitive.
struct alignas(16) Quad {
    float v[4];
};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Quad kHighest{{kInfinity, kInfinity, kInfinity, kInfinity}};
constexpr Quad kLowest{{-kInfinity, -kInfinity, -kInfinity, -kInfinity}};

/// A box. The fourth component of its lower corner holds the index of its primitive.
struct Primitive {
    Quad lower, upper;

    Primitive() = default;
    Primitive(const Aabb& b, std::uint32_t index)
        : lower{{b.lower[0], b.lower[1], b.lower[2], std::bit_cast<float>(index | kNumber)}},
          upper{{b.upper[0], b.upper[1], b.upper[2], 0}} {}
    [[nodiscard]] std::uint32_t index() const {
        return std::bit_cast<std::uint32_t>(lower.v[3]) & ~kNumber;
    }

private:
    /// Set in every index, so that an index below 2^28 reads as a float of ordinary magnitude.
    static constexpr std::uint32_t kNumber = 0x40000000;
};

} // namespace abut::build_tree_detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace build_tree_detail; // NOLINT(google-build-using-namespace): its own, shared part

namespace hn = hwy::HWY_NAMESPACE;
using D4 = hn::CappedTag<float, 4>;

/// Applies the operation to each lane.
template <typename Operation>
Quad combine(const Quad& a, const Quad& b, const Operation& operation) {
    const D4 d;
    Quad r{};
    for (std::size_t i = 0; i < 4; i += hn::Lanes(d))
        hn::Store(operation(hn::Load(d, a.v + i), hn::Load(d, b.v + i)), d, r.v + i);
    return r;
}
Quad min(const Quad& a, const Quad& b) {
    return combine(a, b, [](auto x, auto y) HWY_ATTR { return hn::Min(x, y); });
}
Quad max(const Quad& a, const Quad& b) {
    return combine(a, b, [](auto x, auto y) HWY_ATTR { return hn::Max(x, y); });
}
Quad operator+(const Quad& a, const Quad& b) {
    return combine(a, b, [](auto x, auto y) HWY_ATTR { return hn::Add(x, y); });
}
Quad operator-(const Quad& a, const Quad& b) {
    return combine(a, b, [](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); });
}
Quad operator*(const Quad& a, const Quad& b) {
    return combine(a, b, [](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); });
}

struct Bounds {
    Quad lower = kHighest, upper = kLowest;

    void merge(const Bounds& other) {
        lower = min(lower, other.lower);
        upper = max(upper, other.upper);
    }
    void extend(const Quad& p) {
        lower = min(lower, p);
        upper = max(upper, p);
    }
    [[nodiscard]] float half_area() const {
        const float x = upper.v[0] - lower.v[0], y = upper.v[1] - lower.v[1],
                    z = upper.v[2] - lower.v[2];
        return x >= 0 ? x * y + y * z + z * x : 0;
    }
};

/// Twice the centre of the primitive's box.
Quad centre(const Primitive& primitive) {
    return primitive.lower + primitive.upper;
}

/// A run of primitives, with the bounds of the primitives and of their centres.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Bounds bounds, centres;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
    void add(const Primitive& primitive) {
        bounds.merge({primitive.lower, primitive.upper});
        centres.extend(centre(primitive));
    }
};

/// A place to cut a range: below the bin `bin` of an axis.
struct Cut {
    std::size_t axis = 0, bin = 0;
    float cost = kInfinity;
};

/// The bins of a range on its three axes.
class Binning {
public:
    explicit Binning(const Range& range) : origin_(range.centres.lower) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float extent = range.centres.upper.v[axis] - range.centres.lower.v[axis];
            // A subnormal extent gives an infinite scale: such an axis is not cut.
            const float s = extent > 0 ? 0.9999F * static_cast<float>(kBins) / extent : 0;
            scale_.v[axis] = s < std::numeric_limits<float>::max() ? s : 0;
        }
    }

    void add(const Primitive& primitive) {
        const Quad place = (centre(primitive) - origin_) * scale_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Bin& bin = bin_[axis][bin_at(place.v[axis])];
            bin.box.merge({primitive.lower, primitive.upper});
            ++bin.count;
        }
    }
    [[nodiscard]] bool is_below(const Primitive& primitive, const Cut& cut) const {
        const float middle = primitive.lower.v[cut.axis] + primitive.upper.v[cut.axis];
        return bin_at((middle - origin_.v[cut.axis]) * scale_.v[cut.axis]) < cut.bin;
    }

    /// The cut with the least sum of area times number of primitives; none if all centres coincide.
    [[nodiscard]] Cut best() const {
        Cut best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (scale_.v[axis] == 0)
                continue;
            std::array<float, kBins> below_cost{};
            std::array<std::uint32_t, kBins> below{};
            Bounds box;
            std::uint32_t count = 0;
            for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
                box.merge(bin_[axis][bin].box);
                count += bin_[axis][bin].count;
                below_cost[bin] = box.half_area() * static_cast<float>(count);
                below[bin] = count;
            }
            box = {};
            count = 0;
            for (std::size_t bin = kBins - 1; bin > 0; --bin) {
                box.merge(bin_[axis][bin].box);
                count += bin_[axis][bin].count;
                const float cost =
                    below_cost[bin - 1] + box.half_area() * static_cast<float>(count);
                if (below[bin - 1] > 0 && count > 0 && cost < best.cost)
                    best = {axis, bin, cost};
            }
        }
        return best;
    }

private:
    struct Bin {
        Bounds box;
        std::uint32_t count = 0;
    };
    [[nodiscard]] std::size_t bin_at(float place) const {
        const auto bin = static_cast<std::int32_t>(place);
        return static_cast<std::size_t>(std::clamp(bin, 0, static_cast<std::int32_t>(kBins) - 1));
    }

    Quad origin_, scale_{};
    std::array<std::array<Bin, kBins>, 3> bin_;
};

class Builder {
public:
    Builder(std::vector<Primitive>& primitives, Tree& tree)
        : primitives_(primitives), tree_(tree) {}

    void build() {
        const auto size = static_cast<std::uint32_t>(primitives_.size());
        const Range all = measure(0, size);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            tree_.bounds.lower[axis] = all.bounds.lower.v[axis];
            tree_.bounds.upper[axis] = all.bounds.upper.v[axis];
        }
        build_node(*claim_node().node, all);
        lay_out();
    }

private:
    Range measure(std::uint32_t begin, std::uint32_t end) const {
        Range r{begin, end, {}, {}};
        for (std::uint32_t i = begin; i < end; ++i)
            r.add(primitives_[i]);
        return r;
    }

    /// Cuts where the surface-area heuristic is least. If all centres coincide, cuts in the middle
    /// of the run. Small ranges are cut at multiples of a leaf, or of a node of full leaves.
    std::array<Range, 2> split(const Range& range) {
        if (range.size() <= kBottomSize)
            return halve(range, kLeafSize);
        if (range.size() <= kBottomSize * Node::kWidth)
            return halve(range, kBottomSize);
        Binning bins(range);
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            bins.add(primitives_[i]);
        const Cut cut = bins.best();
        return cut.cost < kInfinity ? partition(range, bins, cut) : halve(range, 1);
    }

    /// Cuts in the middle of the longest axis of the centres, rounded to a multiple of the quantum.
    std::array<Range, 2> halve(const Range& range, std::uint32_t quantum) {
        const Quad extent = range.centres.upper - range.centres.lower;
        const auto axis =
            static_cast<std::size_t>(std::max_element(extent.v, extent.v + 3) - extent.v);
        const std::uint32_t cut = range.begin + (range.size() / quantum + 1) / 2 * quantum;
        select(&primitives_[range.begin], &primitives_[range.end - 1], &primitives_[cut], axis);
        return {measure(range.begin, cut), measure(cut, range.end)};
    }

    /// Partially sorts the range along the axis: `nth` receives the primitive that belongs there,
    /// and smaller ones come before it. Source: [Hoare 1961], quickselect.
    static void select(Primitive* low, Primitive* high, const Primitive* nth, std::size_t axis) {
        const auto key = [axis](const Primitive& p)
                             HWY_ATTR { return p.lower.v[axis] + p.upper.v[axis]; };
        while (low < high) {
            const float pivot = key(low[(high - low) / 2]);
            Primitive *i = low, *j = high;
            while (i <= j) {
                while (key(*i) < pivot)
                    ++i;
                while (pivot < key(*j))
                    --j;
                if (i <= j)
                    std::swap(*i++, *j--);
            }
            if (nth <= j)
                high = j;
            else if (nth >= i)
                low = i;
            else
                return;
        }
    }

    std::array<Range, 2> partition(const Range& range, const Binning& bins, const Cut& cut) {
        std::array<Range, 2> halves;
        std::uint32_t low = range.begin, high = range.end;
        while (low < high) {
            if (bins.is_below(primitives_[low], cut))
                halves[0].add(primitives_[low++]);
            else {
                std::swap(primitives_[low], primitives_[--high]);
                halves[1].add(primitives_[high]);
            }
        }
        halves[0].begin = range.begin, halves[0].end = halves[1].begin = low;
        halves[1].end = range.end;
        return halves;
    }

    /// A new node. Its address stays valid while other threads claim nodes.
    struct Claim {
        std::uint32_t index;
        Node* node;
    };
    Claim claim_node() {
        const std::scoped_lock lock(claiming_);
        nodes_.emplace_back();
        return {static_cast<std::uint32_t>(nodes_.size() - 1), &nodes_.back()};
    }

    void build_node(Node& node, const Range& range) {
        // Open the child of largest area until the node is full or no child is large enough. In a
        // node of more than kBottomSize primitives, children of at most kBottomSize stay whole:
        // they become nodes of full leaves. In a smaller node, children are opened down to leaves.
        const std::uint32_t opened = range.size() > kBottomSize ? kBottomSize : kLeafSize;
        std::array<Range, Node::kWidth> children{range};
        std::size_t count = 1;
        while (count < Node::kWidth) {
            std::size_t widest = Node::kWidth;
            float area = -1;
            for (std::size_t i = 0; i < count; ++i)
                if (children[i].size() > opened && children[i].bounds.half_area() > area)
                    widest = i, area = children[i].bounds.half_area();
            if (widest == Node::kWidth)
                break;
            const auto halves = split(children[widest]);
            children[widest] = halves[0];
            children[count++] = halves[1];
        }

        std::array<Node*, Node::kWidth> below{};
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            const Range child = i < count ? children[i] : Range{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.lower[axis][i] = child.bounds.lower.v[axis];
                node.upper[axis][i] = child.bounds.upper.v[axis];
            }
            if (i >= count)
                node.child[i] = NodeRef::none();
            else if (child.size() <= kLeafSize)
                node.child[i] = NodeRef::leaf(child.begin, child.size());
            else {
                const Claim claim = claim_node();
                node.child[i] = NodeRef::node(claim.index);
                below[i] = claim.node;
            }
        }
        parallel_for(count, range.size() >= kParallelSplit ? 1 : count, [&](std::size_t i) {
            if (below[i] != nullptr)
                build_node(*below[i], children[i]);
        });
    }

    /// Copies the nodes to the tree depth first, so that the order does not depend on the threads.
    /// Each leaf's slots start at a multiple of the leaf size.
    void lay_out() {
        tree_.nodes.reserve(nodes_.size());
        tree_.order.reserve(primitives_.size() + primitives_.size() / 8);
        copy(0);
        tree_.order.shrink_to_fit();
    }
    std::uint32_t copy(std::uint32_t from) {
        const auto to = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.push_back(nodes_[from]);
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            const NodeRef child = tree_.nodes[to].child[i];
            if (child.is_none())
                break;
            tree_.nodes[to].child[i] =
                child.is_leaf() ? copy_leaf(child) : NodeRef::node(copy(child.index()));
        }
        return to;
    }
    NodeRef copy_leaf(NodeRef leaf) {
        const auto first = static_cast<std::uint32_t>(tree_.order.size());
        for (std::uint32_t i = 0; i < kLeafSize; ++i)
            tree_.order.push_back(primitives_[leaf.first() + (i < leaf.count() ? i : 0)].index());
        return NodeRef::leaf(first, leaf.count());
    }

    std::vector<Primitive>& primitives_;
    Tree& tree_;
    std::deque<Node> nodes_; ///< in the order in which threads claimed them
    std::mutex claiming_;
};

void build(std::vector<Primitive>& primitives, Tree& tree) {
    Builder(primitives, tree).build();
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(build);

namespace {

using build_tree_detail::Primitive;

Tree build_tree(std::vector<Primitive>& primitives) {
    if (primitives.size() >= (1U << 28))
        throw std::length_error("tree: 2^28 primitives or more");
    Tree tree;
    if (!primitives.empty())
        HWY_DYNAMIC_DISPATCH(build)(primitives, tree);
    return tree;
}

} // namespace

Tree build_tree(std::span<const Aabb> boxes) {
    std::vector<Primitive> primitives(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        primitives[i] = Primitive(boxes[i], static_cast<std::uint32_t>(i));
    Tree tree = build_tree(primitives);
    for (Node& node : tree.nodes)
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            node.bounds.merge(node.box(i));
    return tree;
}

Tree build_tree(const TreeMesh& mesh, bool own_axes) {
    std::vector<Primitive> primitives(mesh.triangles.size());
    parallel_for(primitives.size(), 4096, [&](std::size_t i) {
        Aabb box;
        for (const std::uint32_t v : mesh.triangles[i])
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto x = to_float(component(mesh.positions[v], static_cast<int>(axis)));
                box.lower[axis] = std::min(box.lower[axis], x);
                box.upper[axis] = std::max(box.upper[axis], x);
            }
        primitives[i] = Primitive(box, static_cast<std::uint32_t>(i));
    });
    Tree tree = build_tree(primitives);
    primitives = std::vector<Primitive>();
    fill_leaves(tree, mesh);
    orient_nodes(tree, mesh, own_axes ? OwnAxes::where_smaller : OwnAxes::never);
    return tree;
}

} // namespace abut
#endif
