#include "core/parallel.h"
#include "math/vector.h"
#include "tree/orient.h"
#include "tree/tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <limits>
#include <stdexcept>

namespace abut {

namespace {

constexpr std::uint32_t kLeafSize = TriangleLeaf::kLanes;
constexpr std::uint32_t kBottomSize = kLeafSize * Node::kWidth; ///< of a node with full leaves
constexpr std::size_t kBins = 16;
constexpr std::uint32_t kParallelSplit =
    4096; // below this many primitives, a task costs more than it saves

/// Four floats that the compiler keeps in one register; the fourth is along for the ride.
struct alignas(16) Quad {
    float v[4];

    void lower(const Quad& other) {
        for (std::size_t i = 0; i < 4; ++i)
            v[i] = other.v[i] < v[i] ? other.v[i] : v[i];
    }
    void raise(const Quad& other) {
        for (std::size_t i = 0; i < 4; ++i)
            v[i] = other.v[i] > v[i] ? other.v[i] : v[i];
    }
};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Quad kHighest{{kInfinity, kInfinity, kInfinity, kInfinity}};
constexpr Quad kLowest{{-kInfinity, -kInfinity, -kInfinity, -kInfinity}};

struct Bounds {
    Quad lower = kHighest, upper = kLowest;

    void merge(const Bounds& other) {
        lower.lower(other.lower);
        upper.raise(other.upper);
    }
    void extend(const Quad& p) {
        lower.lower(p);
        upper.raise(p);
    }
    [[nodiscard]] float half_area() const {
        const float x = upper.v[0] - lower.v[0], y = upper.v[1] - lower.v[1],
                    z = upper.v[2] - lower.v[2];
        return x >= 0 ? x * y + y * z + z * x : 0;
    }
};

/// A box, and in place of the fourth coordinate of its lower corner the number of its primitive.
struct Primitive {
    Bounds box;

    Primitive() = default;
    Primitive(const Aabb& b, std::uint32_t index) {
        for (std::size_t i = 0; i < 3; ++i)
            box.lower.v[i] = b.lower[i], box.upper.v[i] = b.upper[i];
        box.lower.v[3] = std::bit_cast<float>(index);
        box.upper.v[3] = 0;
    }
    [[nodiscard]] std::uint32_t index() const {
        return std::bit_cast<std::uint32_t>(box.lower.v[3]);
    }
    [[nodiscard]] Quad centre() const {
        Quad c;
        for (std::size_t i = 0; i < 4; ++i)
            c.v[i] = 0.5F * box.lower.v[i] + 0.5F * box.upper.v[i];
        return c;
    }
};

/// A run of primitives and their boxes: of the primitives, and of their centres.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Bounds bounds, centres;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
    void add(const Primitive& primitive) {
        bounds.merge(primitive.box);
        centres.extend(primitive.centre());
    }
};

/// Where a range is cut: below a bin of an axis.
struct Cut {
    std::size_t axis = 0, bin = 0;
    std::uint32_t below = 0; ///< primitives there
    float cost = kInfinity;
};

/// The bins of a range on its three axes.
class Binning {
public:
    explicit Binning(const Range& range)
        : bins_(range.size() >= 4 * kBins ? kBins : kBins / 2), origin_(range.centres.lower) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float extent = range.centres.upper.v[axis] - range.centres.lower.v[axis];
            // A subnormal extent gives an infinite scale: such an axis is not cut.
            const float s = extent > 0 ? 0.9999F * static_cast<float>(bins_) / extent : 0;
            scale_.v[axis] = s < std::numeric_limits<float>::max() ? s : 0;
        }
    }

    void add(const Primitive& primitive) {
        const Quad c = primitive.centre();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Bin& bin = bin_[axis][bin_of(c, axis)];
            bin.box.merge(primitive.box);
            ++bin.count;
        }
    }
    [[nodiscard]] bool is_below(const Primitive& primitive, const Cut& cut) const {
        return bin_of(primitive.centre(), cut.axis) < cut.bin;
    }

    /// The cut of least area times primitives, counted in quanta; none if all centres coincide.
    [[nodiscard]] Cut best(std::uint32_t size, std::uint32_t quantum) const {
        Cut best;
        const auto quanta = [&](std::uint32_t count) {
            return static_cast<float>((count + quantum - 1) / quantum);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (scale_.v[axis] == 0)
                continue;
            std::array<float, kBins> below_cost{};
            std::array<std::uint32_t, kBins> below{};
            Bounds box;
            std::uint32_t count = 0;
            for (std::size_t bin = 0; bin + 1 < bins_; ++bin) {
                box.merge(bin_[axis][bin].box);
                count += bin_[axis][bin].count;
                below_cost[bin] = box.half_area() * quanta(count);
                below[bin] = count;
            }
            box = {};
            for (std::size_t bin = bins_ - 1; bin > 0; --bin) {
                box.merge(bin_[axis][bin].box);
                const std::uint32_t above = size - below[bin - 1];
                const float cost = below_cost[bin - 1] + box.half_area() * quanta(above);
                if (below[bin - 1] > 0 && above > 0 && cost < best.cost)
                    best = {axis, bin, below[bin - 1], cost};
            }
        }
        return best;
    }

private:
    struct Bin {
        Bounds box;
        std::uint32_t count = 0;
    };
    [[nodiscard]] std::size_t bin_of(const Quad& centre, std::size_t axis) const {
        const auto bin =
            static_cast<std::int32_t>((centre.v[axis] - origin_.v[axis]) * scale_.v[axis]);
        return std::min(static_cast<std::size_t>(std::max(bin, 0)), bins_ - 1);
    }

    std::size_t bins_;
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
        // Every node has two children at least, so there are fewer nodes than primitives.
        nodes_.resize(std::max<std::size_t>(1, size - 1));
        build_node(next_node_++, all);
        lay_out();
    }

private:
    Range measure(std::uint32_t begin, std::uint32_t end) const {
        Range r{begin, end, {}, {}};
        for (std::uint32_t i = begin; i < end; ++i)
            r.add(primitives_[i]);
        return r;
    }

    /// Cuts where the surface-area heuristic is least; in the middle of the run if all centres
    /// coincide. Small ranges are cut at multiples of a leaf or of a node of leaves.
    std::array<Range, 2> split(const Range& range) {
        const std::uint32_t quantum = range.size() <= kBottomSize                  ? kLeafSize
                                      : range.size() <= kBottomSize * Node::kWidth ? kBottomSize
                                                                                   : 1;
        Binning bins(range);
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            bins.add(primitives_[i]);
        const Cut cut = bins.best(range.size(), quantum);
        std::uint32_t below = cut.cost < kInfinity ? cut.below : range.size() / 2;
        if (quantum == 1 && cut.cost < kInfinity)
            return partition(range, bins, cut);
        below =
            std::clamp((below + quantum / 2) / quantum, 1U, (range.size() - 1) / quantum) * quantum;
        const auto begin = primitives_.begin() + range.begin;
        if (cut.cost < kInfinity)
            std::nth_element(begin, begin + below, primitives_.begin() + range.end,
                             [axis = cut.axis](const Primitive& p, const Primitive& q) {
                                 return p.box.lower.v[axis] + p.box.upper.v[axis] <
                                        q.box.lower.v[axis] + q.box.upper.v[axis];
                             });
        return {measure(range.begin, range.begin + below), measure(range.begin + below, range.end)};
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

    void build_node(std::uint32_t index, const Range& range) {
        // Open the child of largest area until the node is full or nothing is left to open: leaves,
        // or what makes a node of full leaves.
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

        Node& node = nodes_[index];
        std::array<std::uint32_t, Node::kWidth> below{};
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
            else
                node.child[i] =
                    NodeRef::node(below[i] = next_node_.fetch_add(1, std::memory_order_relaxed));
        }
        parallel_for(count, range.size() >= kParallelSplit ? 1 : count, [&](std::size_t i) {
            if (below[i] != 0)
                build_node(below[i], children[i]);
        });
    }

    /// Nodes depth first, whatever order the threads made them in; a leaf's slots from a multiple
    /// of its size.
    void lay_out() {
        tree_.nodes.reserve(next_node_);
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
    std::vector<Node> nodes_;
    std::atomic<std::uint32_t> next_node_{0};
};

Tree build(std::vector<Primitive>& primitives) {
    if (primitives.size() >= (1U << 28))
        throw std::length_error("tree: 2^28 primitives or more");
    Tree tree;
    if (!primitives.empty())
        Builder(primitives, tree).build();
    return tree;
}

} // namespace

Tree build_tree(std::span<const Aabb> boxes) {
    std::vector<Primitive> primitives(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        primitives[i] = Primitive(boxes[i], static_cast<std::uint32_t>(i));
    Tree tree = build(primitives);
    for (Node& node : tree.nodes)
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            node.bounds.merge(node.box(i));
    return tree;
}

Tree build_tree(const TreeMesh& mesh) {
    std::vector<Primitive> primitives(mesh.triangles.size());
    parallel_for(primitives.size(), 4096, [&](std::size_t i) {
        Aabb box;
        for (const std::uint32_t v : mesh.triangles[i])
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto x =
                    static_cast<float>(component(mesh.positions[v], static_cast<int>(axis)));
                box.lower[axis] = std::min(box.lower[axis], x);
                box.upper[axis] = std::max(box.upper[axis], x);
            }
        primitives[i] = Primitive(box, static_cast<std::uint32_t>(i));
    });
    Tree tree = build(primitives);
    primitives = {};
    orient_nodes(tree, mesh);
    return tree;
}

} // namespace abut
