#include "core/parallel.h"
#include "tree/tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace abut {

namespace {

constexpr std::size_t kBins = 16;
constexpr std::uint32_t kParallelSplit =
    4096; // below this many primitives, a task costs more than it saves

/// A run of the order and its boxes: of the primitives, and of their centres.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Aabb bounds, centres;
    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

class Builder {
public:
    Builder(std::span<const Aabb> boxes, std::uint32_t leaf_size, Tree& tree)
        : boxes_(boxes), leaf_size_(leaf_size), tree_(tree) {}

    void build() {
        auto& order = tree_.order;
        order.resize(boxes_.size());
        std::iota(order.begin(), order.end(), 0U);
        Range all = measure(0, static_cast<std::uint32_t>(boxes_.size()));
        tree_.bounds = all.bounds;
        // Every node has two children at least, so there are fewer nodes than primitives.
        tree_.nodes.resize(std::max<std::size_t>(1, boxes_.size() - 1));
        build_node(claim_node(), all);
        tree_.nodes.resize(next_node_);
        tree_.nodes.shrink_to_fit();
    }

private:
    std::uint32_t claim_node() { return next_node_.fetch_add(1, std::memory_order_relaxed); }

    [[nodiscard]] std::array<float, 3> centre(std::uint32_t primitive) const {
        const Aabb& b = boxes_[primitive];
        return {b.lower[0] * 0.5F + b.upper[0] * 0.5F, b.lower[1] * 0.5F + b.upper[1] * 0.5F,
                b.lower[2] * 0.5F + b.upper[2] * 0.5F};
    }

    Range measure(std::uint32_t begin, std::uint32_t end) const {
        Range r{begin, end, {}, {}};
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t primitive = tree_.order[i];
            r.bounds.merge(boxes_[primitive]);
            const auto c = centre(primitive);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                r.centres.lower[axis] = std::min(r.centres.lower[axis], c[axis]);
                r.centres.upper[axis] = std::max(r.centres.upper[axis], c[axis]);
            }
        }
        return r;
    }

    /// Splits where the surface-area heuristic is least; in the middle of the run if all centres
    /// coincide.
    std::array<Range, 2> split(const Range& range) {
        struct Bin {
            Aabb box;
            std::uint32_t count = 0;
        };
        std::array<std::array<Bin, kBins>, 3> bins{};
        std::array<float, 3> scale{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float extent = range.centres.upper[axis] - range.centres.lower[axis];
            // A subnormal extent gives an infinite scale: such an axis is not split.
            const float s = extent > 0 ? static_cast<float>(kBins) / extent : 0;
            scale[axis] = s < std::numeric_limits<float>::max() ? s : 0;
        }
        const auto bin_of = [&](float c, std::size_t axis) {
            const auto bin =
                static_cast<std::size_t>((c - range.centres.lower[axis]) * scale[axis]);
            return std::min(bin, kBins - 1);
        };
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const std::uint32_t primitive = tree_.order[i];
            const auto c = centre(primitive);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Bin& bin = bins[axis][bin_of(c[axis], axis)];
                bin.box.merge(boxes_[primitive]);
                ++bin.count;
            }
        }

        float best_cost = std::numeric_limits<float>::infinity();
        std::size_t best_axis = 0, best_bin = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (scale[axis] == 0)
                continue;
            std::array<float, kBins> below{};
            Aabb box;
            std::uint32_t count = 0;
            for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
                box.merge(bins[axis][bin].box);
                count += bins[axis][bin].count;
                below[bin] = box.half_area() * static_cast<float>(count);
            }
            box = {};
            count = 0;
            for (std::size_t bin = kBins - 1; bin > 0; --bin) {
                box.merge(bins[axis][bin].box);
                count += bins[axis][bin].count;
                const float cost = below[bin - 1] + box.half_area() * static_cast<float>(count);
                if (count > 0 && count < range.size() && cost < best_cost)
                    best_cost = cost, best_axis = axis, best_bin = bin;
            }
        }

        const auto begin = tree_.order.begin() + range.begin, end = tree_.order.begin() + range.end;
        auto middle = begin + range.size() / 2;
        if (best_cost < std::numeric_limits<float>::infinity())
            middle = std::partition(begin, end, [&](std::uint32_t primitive) {
                return bin_of(centre(primitive)[best_axis], best_axis) < best_bin;
            });
        const auto cut = static_cast<std::uint32_t>(middle - tree_.order.begin());
        return {measure(range.begin, cut), measure(cut, range.end)};
    }

    void build_node(std::uint32_t index, const Range& range) {
        // Open the child of largest area until the node is full or all children are leaves.
        std::array<Range, Node::kWidth> children{range};
        std::size_t count = 1;
        while (count < Node::kWidth) {
            std::size_t widest = Node::kWidth;
            float area = -1;
            for (std::size_t i = 0; i < count; ++i)
                if (children[i].size() > leaf_size_ && children[i].bounds.half_area() > area)
                    widest = i, area = children[i].bounds.half_area();
            if (widest == Node::kWidth)
                break;
            const auto halves = split(children[widest]);
            children[widest] = halves[0];
            children[count++] = halves[1];
        }

        Node& node = tree_.nodes[index];
        std::array<std::uint32_t, Node::kWidth> below{};
        for (std::size_t i = 0; i < Node::kWidth; ++i) {
            const Range child = i < count ? children[i] : Range{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.lower[axis][i] = child.bounds.lower[axis];
                node.upper[axis][i] = child.bounds.upper[axis];
            }
            if (i >= count)
                node.child[i] = NodeRef::none();
            else if (child.size() <= leaf_size_)
                node.child[i] = NodeRef::leaf(child.begin, child.size());
            else
                node.child[i] = NodeRef::node(below[i] = claim_node());
        }
        parallel_for(count, range.size() >= kParallelSplit ? 1 : count, [&](std::size_t i) {
            if (below[i] != 0)
                build_node(below[i], children[i]);
        });
    }

    std::span<const Aabb> boxes_;
    std::uint32_t leaf_size_;
    Tree& tree_;
    std::atomic<std::uint32_t> next_node_{0};
};

Aabb validate_below(const Tree& tree, NodeRef ref, std::span<const Aabb> boxes,
                    std::vector<std::uint8_t>& seen) {
    Aabb box;
    if (ref.is_leaf()) {
        for (std::uint32_t slot = ref.first(); slot < ref.first() + ref.count(); ++slot) {
            if (slot >= tree.order.size() || seen[slot]++ != 0)
                throw std::logic_error("tree: a slot is in two leaves or out of range");
            box.merge(boxes[tree.order[slot]]);
        }
        return box;
    }
    const Node& node = tree.nodes.at(ref.index());
    for (std::size_t i = 0; i < Node::kWidth; ++i) {
        if (node.child[i].is_none())
            continue;
        const Aabb inner = validate_below(tree, node.child[i], boxes, seen), outer = node.box(i);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (inner.lower[axis] < outer.lower[axis] || inner.upper[axis] > outer.upper[axis])
                throw std::logic_error("tree: a box does not enclose its children");
        box.merge(outer);
    }
    return box;
}

} // namespace

Tree build_tree(std::span<const Aabb> boxes, const TreeOptions& options) {
    if (boxes.size() >= (1U << 28))
        throw std::length_error("tree: 2^28 primitives or more");
    Tree tree;
    if (!boxes.empty())
        Builder(boxes, options.leaf_size, tree).build();
    return tree;
}

void validate(const Tree& tree, std::span<const Aabb> boxes) {
    if (tree.empty() != boxes.empty() || tree.order.size() != boxes.size())
        throw std::logic_error("tree: wrong number of primitives");
    if (tree.empty())
        return;
    std::vector<std::uint8_t> seen(tree.order.size());
    validate_below(tree, NodeRef::node(0), boxes, seen);
    if (std::find(seen.begin(), seen.end(), 0) != seen.end())
        throw std::logic_error("tree: a slot is in no leaf");
}

} // namespace abut
