#include "view/levels/level_plan.h"

#include "math/vector.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace abut {

namespace {

constexpr std::size_t kBranches = 4;
/// An instance counts as a part of its triangles: it adds no stored leaf.
constexpr std::uint64_t kInstanceShare = 4;

struct ItemRange {
    std::uint32_t begin = 0, end = 0;
    std::uint64_t weight = 0;
    [[nodiscard]] std::uint32_t count() const { return end - begin; }
};

/// Spreads the bits of a number: two zero bits follow each.
std::uint64_t with_gaps(std::uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffff;
    v = (v | v << 16) & 0x001f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

class Planner {
public:
    explicit Planner(std::vector<LevelItem>& items) : items_(items) {}

    std::vector<PlannedNode> run() {
        std::sort(items_.begin(), items_.end());
        if (items_.empty())
            return {};
        add_children(size_classes(), true);
        for (std::uint32_t i = 0; i < nodes_.size(); ++i)
            if (nodes_[i].slice == kNoSlice && !nodes_[i].is_leaf_for_good)
                divide(i);
        std::vector<PlannedNode> result(nodes_.begin(), nodes_.end());
        return result;
    }

private:
    struct Node : PlannedNode {
        bool is_leaf_for_good = false;
    };

    [[nodiscard]] ItemRange range(std::uint32_t begin, std::uint32_t end) const {
        ItemRange result{begin, end, 0};
        for (std::uint32_t i = begin; i < end; ++i)
            result.weight += items_[i].is_instance()
                                 ? std::max<std::uint64_t>(items_[i].triangles / kInstanceShare, 1)
                                 : items_[i].triangles;
        return result;
    }

    /// The ranges of the classes; a class with few triangles joins the next larger one.
    [[nodiscard]] std::vector<ItemRange> size_classes() const {
        std::vector<ItemRange> classes;
        std::uint32_t begin = 0;
        const auto count = static_cast<std::uint32_t>(items_.size());
        for (std::uint32_t i = 1; i <= count; ++i) {
            if (i < count && items_[i].size_class == items_[begin].size_class)
                continue;
            const ItemRange found = range(begin, i);
            if (i < count && found.weight < kLeafTriangles / 2)
                continue; // its triangles are counted with those of the next class
            classes.push_back(found);
            begin = i;
        }
        return classes;
    }

    void add_children(const std::vector<ItemRange>& ranges, bool is_root) {
        if (is_root) {
            nodes_.push_back({});
            nodes_[0].end = static_cast<std::uint32_t>(items_.size());
            if (ranges.size() < 2)
                return;
            nodes_[0].first_child = 1;
            nodes_[0].children = static_cast<std::uint32_t>(ranges.size());
            nodes_[0].is_leaf_for_good = true; // is divided
        }
        for (const ItemRange& child : ranges) {
            Node& node = nodes_.emplace_back();
            node.begin = child.begin, node.end = child.end;
        }
    }

    void divide(std::uint32_t at) {
        const ItemRange all = range(nodes_[at].begin, nodes_[at].end);
        nodes_[at].is_leaf_for_good = true;
        const auto first = static_cast<std::uint32_t>(nodes_.size());
        if (all.weight > kLeafTriangles && all.count() == 1 && !items_[all.begin].is_instance())
            add_slices(all);
        else if (all.weight > kLeafTriangles && all.count() > 1)
            add_children(divided(all), false);
        else if (all.count() > 1)
            add_group(all);
        nodes_[at].first_child = first;
        nodes_[at].children = static_cast<std::uint32_t>(nodes_.size()) - first;
    }

    void add_slices(const ItemRange& item) {
        const std::uint32_t slices =
            (items_[item.begin].triangles + kLeafTriangles - 1) / kLeafTriangles;
        for (std::uint32_t i = 0; i < slices; ++i) {
            Node& node = nodes_.emplace_back();
            node.begin = item.begin, node.end = item.end;
            node.slice = i, node.slices = slices;
            node.is_leaf_for_good = true;
        }
    }

    /// A leaf, if it has no instances; else a leaf of the other items, and one for each instance.
    void add_group(const ItemRange& all) {
        const auto begin = items_.begin() + all.begin, end = items_.begin() + all.end;
        const auto first = std::stable_partition(
            begin, end, [](const LevelItem& item) { return !item.is_instance(); });
        if (first == end)
            return;
        const auto merged = static_cast<std::uint32_t>(first - begin);
        const auto add = [&](std::uint32_t from, std::uint32_t to) {
            Node& node = nodes_.emplace_back();
            node.begin = from, node.end = to;
            node.is_leaf_for_good = true;
        };
        if (merged > 0)
            add(all.begin, all.begin + merged);
        for (std::uint32_t i = all.begin + merged; i < all.end; ++i)
            add(i, i + 1);
    }

    /// Up to four ranges: the heaviest is halved again and again.
    [[nodiscard]] std::vector<ItemRange> divided(const ItemRange& all) const {
        std::vector<ItemRange> ranges{all};
        while (ranges.size() < kBranches) {
            const auto heaviest =
                std::max_element(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) {
                    return (a.count() > 1 ? a.weight : 0) < (b.count() > 1 ? b.weight : 0);
                });
            if (heaviest->count() < 2 || heaviest->weight <= kLeafTriangles)
                break;
            const ItemRange whole = *heaviest;
            const std::uint32_t cut = cut_of(whole);
            *heaviest = range(whole.begin, cut);
            ranges.insert(heaviest + 1, range(cut, whole.end));
        }
        return ranges;
    }

    /// Where the highest bit of the place that differs becomes one.
    [[nodiscard]] std::uint32_t cut_of(const ItemRange& whole) const {
        const auto begin = items_.begin() + whole.begin, end = items_.begin() + whole.end;
        // Classes that were joined are not in the order of their places.
        if (begin->size_class != (end - 1)->size_class) {
            const auto first = std::find_if(begin, end, [&](const LevelItem& item) {
                return item.size_class != begin->size_class;
            });
            return static_cast<std::uint32_t>(first - items_.begin());
        }
        const std::uint64_t differs = begin->place ^ (end - 1)->place;
        if (differs == 0)
            return whole.begin + whole.count() / 2;
        const std::uint64_t bit = std::bit_floor(differs);
        const auto first = std::partition_point(
            begin, end, [&](const LevelItem& i) { return (i.place & bit) == 0; });
        return static_cast<std::uint32_t>(first - items_.begin());
    }

    std::vector<LevelItem>& items_;
    std::vector<Node> nodes_;
};

} // namespace

bool operator<(const LevelItem& a, const LevelItem& b) {
    return std::tie(a.size_class, a.place, a.part, a.block) <
           std::tie(b.size_class, b.place, b.part, b.block);
}

std::int8_t size_class(const Box3& box) {
    const double size = max_abs(box.upper - box.lower);
    if (!(size > 0))
        return -40;
    return static_cast<std::int8_t>(std::clamp(std::floor(std::log2(size) / 3), -40.0, 40.0));
}

PlaceCurve::PlaceCurve(const Box3& bounds) {
    const double extent = max_abs(bounds.upper - bounds.lower);
    const double side = extent > 0 ? std::exp2(std::ceil(std::log2(extent))) : 1;
    cell_ = 2 * side / (1 << 21);
    const auto aligned = [&](double v) { return std::floor(v / side * 8) * (side / 8); };
    lower_ = {aligned(bounds.lower.x), aligned(bounds.lower.y), aligned(bounds.lower.z)};
}

std::uint64_t PlaceCurve::place(const Box3& box) const {
    const auto step = [&](double lower, double upper, double from) {
        const double at = ((lower + upper) / 2 - from) / cell_;
        return with_gaps(static_cast<std::uint64_t>(std::clamp(at, 0.0, 2097151.0)));
    };
    return step(box.lower.x, box.upper.x, lower_.x) |
           step(box.lower.y, box.upper.y, lower_.y) << 1 |
           step(box.lower.z, box.upper.z, lower_.z) << 2;
}

std::vector<PlannedNode> plan_levels(std::vector<LevelItem>& items) {
    return Planner(items).run();
}

} // namespace abut
