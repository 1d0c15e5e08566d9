#include "massive/work/work_units.h"

#include <abut/error.h>

#include "massive/work/metis_partition.h"
#include "math/vector.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

namespace abut {

namespace {

/// Partitioning more nodes than this would take more than about 100 MB. Such a graph is first
/// halved in space.
constexpr std::size_t kMostNodes = 250'000;
constexpr std::size_t kMostSubgraphs = 64; ///< of one call of cut_graph
/// Safety factor for the number of subgraphs: METIS balances the weights only to some per cent, and
/// subgraphs share meshes.
constexpr double kRoom = 1.25;

class Partition {
public:
    Partition(const StoredParts& stored, std::uint64_t budget, const std::string& store)
        : stored_(stored), budget_(budget), mesh_stamp_(stored.meshes.size()),
          shown_(stored.meshes.size()), store_(store) {}

    void cut(std::vector<IndexPair> pairs, bool is_cut = false) {
        if (pairs.empty())
            return;
        WorkUnit unit = unit_of(std::move(pairs), is_cut);
        if (unit.bytes <= budget_) {
            units_.push_back(std::move(unit));
            return;
        }
        std::vector<std::vector<IndexPair>> lists = split(unit);
        const std::size_t all = unit.pairs.size();
        if (std::any_of(lists.begin(), lists.end(),
                        [&](const auto& list) { return list.size() == all; })) {
            fill_in_order(unit.pairs, is_cut);
            return;
        }
        unit = WorkUnit();
        for (std::size_t i = 0; i < lists.size(); ++i)
            cut(std::move(lists[i]), is_cut || i + 1 == lists.size());
    }

    /// Fills units with the pairs in the given order, each up to the budget.
    void fill_in_order(const std::vector<IndexPair>& pairs, bool is_cut = false) {
        std::vector<IndexPair> some;
        std::uint64_t bytes = 0;
        ++stamp_;
        const auto cost = [&](const IndexPair& pair) {
            const std::uint32_t a = mesh_of(pair.a()), b = mesh_of(pair.b());
            return (mesh_stamp_[a] == stamp_ ? 0 : bytes_of(a)) +
                   (mesh_stamp_[b] == stamp_ || a == b ? 0 : bytes_of(b));
        };
        for (const IndexPair& pair : pairs) {
            // A pair that needs no further mesh always joins the current unit, even one that
            // exceeds the budget.
            if (cost(pair) > 0 && bytes + cost(pair) > budget_ && !some.empty()) {
                units_.push_back(unit_of(std::exchange(some, {}), is_cut));
                ++stamp_;
                bytes = 0;
            }
            bytes += cost(pair);
            if (bytes > 2 * budget_)
                fail(bytes);
            mesh_stamp_[mesh_of(pair.a())] = mesh_stamp_[mesh_of(pair.b())] = stamp_;
            some.push_back(pair);
        }
        if (!some.empty())
            units_.push_back(unit_of(std::move(some), is_cut));
    }

    std::vector<WorkUnit> take() { return std::move(units_); }

private:
    [[nodiscard]] std::uint32_t mesh_of(std::uint32_t part) const {
        return stored_.parts[part].mesh;
    }
    [[nodiscard]] std::uint64_t bytes_of(std::uint32_t mesh) const {
        return stored_.meshes[mesh].bytes;
    }
    [[noreturn]] void fail(std::uint64_t bytes) const {
        throw Error(ErrorCode::bad_argument, store_,
                    "has two parts that need " + std::to_string(bytes >> 20) +
                        " MiB together; the memory leaves " + std::to_string(2 * budget_ >> 20) +
                        " MiB");
    }

    WorkUnit unit_of(std::vector<IndexPair> pairs, bool is_cut) {
        WorkUnit unit;
        unit.pairs = std::move(pairs);
        unit.cut = is_cut;
        std::sort(unit.pairs.begin(), unit.pairs.end());
        ++stamp_;
        for (const IndexPair& pair : unit.pairs)
            for (const std::uint32_t mesh : {mesh_of(pair.a()), mesh_of(pair.b())})
                if (mesh_stamp_[mesh] != stamp_ && bytes_of(mesh) > 0) {
                    mesh_stamp_[mesh] = stamp_;
                    unit.meshes.push_back(mesh);
                    unit.bytes += bytes_of(mesh);
                }
        std::sort(unit.meshes.begin(), unit.meshes.end());
        unit.alone = unit.bytes > budget_;
        return unit;
    }

    /// A node of the graph of a list of pairs: a part, or a cell of a part with a large mesh.
    struct Node {
        std::uint32_t part = 0;
        std::uint64_t cell = 0;
        Vec3 middle;

        friend bool operator<(const Node& x, const Node& y) {
            return x.part != y.part ? x.part < y.part : x.cell < y.cell;
        }
        friend bool operator==(const Node& x, const Node& y) {
            return x.part == y.part && x.cell == y.cell;
        }
    };

    [[nodiscard]] Node node_of(const IndexPair& pair, std::uint32_t part) const {
        if (bytes_of(mesh_of(part)) == 0) {
            const PairCell cell = stored_.cell_of(pair);
            if (cell.part == part)
                return {part, cell.cell, cell.middle};
        }
        const Box3& box = stored_.boxes[part];
        return {part, 0, 0.5 * box.lower + 0.5 * box.upper};
    }

    /// Returns the pairs within each subgraph, then, as the last list, the pairs that were cut.
    std::vector<std::vector<IndexPair>> split(const WorkUnit& unit) {
        std::vector<Node> nodes;
        for (const IndexPair& pair : unit.pairs)
            nodes.insert(nodes.end(), {node_of(pair, pair.a()), node_of(pair, pair.b())});
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        std::vector<GraphEdge> edges;
        edges.reserve(unit.pairs.size());
        const auto index = [&](const Node& node) {
            return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                              nodes.begin());
        };
        for (const IndexPair& pair : unit.pairs)
            edges.push_back({index(node_of(pair, pair.a())), index(node_of(pair, pair.b()))});
        // Consecutive cells of a part share blocks: an edge between them keeps them together.
        for (std::uint32_t i = 1; i < nodes.size(); ++i)
            if (nodes[i].part == nodes[i - 1].part)
                edges.push_back({i - 1, i});
        const bool in_space = nodes.size() > kMostNodes;
        const std::size_t subgraphs = in_space ? 2 : subgraphs_for(unit, nodes.size());
        const std::vector<std::int32_t> part =
            in_space ? halve(nodes)
                     : cut_graph(weights_of(unit, nodes), edges, static_cast<int>(subgraphs));
        std::vector<std::vector<IndexPair>> lists(subgraphs + 1);
        for (std::size_t i = 0; i < unit.pairs.size(); ++i) {
            const std::int32_t a = part[edges[i].a], b = part[edges[i].b];
            (a == b ? lists[static_cast<std::size_t>(a)] : lists.back()).push_back(unit.pairs[i]);
        }
        return lists;
    }

    /// Returns the number of subgraphs to cut a unit into: at least 2, because the unit exceeds the
    /// budget.
    [[nodiscard]] std::size_t subgraphs_for(const WorkUnit& unit, std::size_t nodes) const {
        const double needed =
            kRoom * static_cast<double>(unit.bytes) / static_cast<double>(budget_);
        return std::min({static_cast<std::size_t>(needed) + 1, kMostSubgraphs, nodes});
    }

    /// Returns the weight of each node. The bytes of a mesh are divided among the nodes that use
    /// it. They are scaled so that the sum of all weights stays below 2^30.
    std::vector<std::int32_t> weights_of(const WorkUnit& unit, const std::vector<Node>& nodes) {
        for (const Node& node : nodes)
            shown_[mesh_of(node.part)] = 0;
        for (const Node& node : nodes)
            ++shown_[mesh_of(node.part)];
        const std::uint64_t unit_bytes = 1 + unit.bytes / (std::uint64_t{1} << 29);
        std::vector<std::int32_t> weights;
        weights.reserve(nodes.size());
        for (const Node& node : nodes) {
            const std::uint32_t mesh = mesh_of(node.part);
            weights.push_back(
                static_cast<std::int32_t>(1 + bytes_of(mesh) / shown_[mesh] / unit_bytes));
        }
        return weights;
    }

    /// Halves the nodes at the median of their middles, along the axis on which they extend
    /// farthest.
    static std::vector<std::int32_t> halve(const std::vector<Node>& nodes) {
        Box3 bounds;
        for (const Node& node : nodes)
            extend(bounds, node.middle);
        const Vec3 extent = bounds.upper - bounds.lower;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                         : extent.y >= extent.z                       ? 1
                                                                      : 2;
        std::vector<std::uint32_t> order(nodes.size());
        std::iota(order.begin(), order.end(), 0U);
        std::nth_element(order.begin(),
                         order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2), order.end(),
                         [&](std::uint32_t i, std::uint32_t k) {
                             const double at = component(nodes[i].middle, axis),
                                          other = component(nodes[k].middle, axis);
                             return at != other ? at < other : i < k;
                         });
        std::vector<std::int32_t> half(nodes.size(), 0);
        for (std::size_t i = order.size() / 2; i < order.size(); ++i)
            half[order[i]] = 1;
        return half;
    }

    const StoredParts& stored_;
    std::uint64_t budget_;
    std::vector<WorkUnit> units_;
    std::vector<std::uint32_t> mesh_stamp_; ///< by mesh: the last list in which it was found
    std::vector<std::uint64_t> shown_;      ///< by mesh: number of nodes that use it
    const std::string& store_;
    std::uint32_t stamp_ = 0;
};

/// Orders the units greedily. Each is followed by a remaining unit that shares the most bytes of
/// meshes with it, or by the first remaining one if none shares any.
std::vector<WorkUnit> in_order_of_sharing(std::vector<WorkUnit> units, const StoredParts& stored) {
    std::vector<std::vector<std::uint32_t>> users(stored.meshes.size());
    for (std::uint32_t u = 0; u < units.size(); ++u)
        for (const std::uint32_t mesh : units[u].meshes)
            users[mesh].push_back(u);
    std::vector<WorkUnit> result;
    std::vector<bool> done(units.size());
    std::size_t first_left = 0, at = 0;
    while (result.size() < units.size()) {
        done[at] = true;
        std::vector<std::uint64_t> shared(units.size());
        for (const std::uint32_t mesh : units[at].meshes)
            for (const std::uint32_t user : users[mesh])
                shared[user] += done[user] ? 0 : stored.meshes[mesh].bytes;
        result.push_back(std::move(units[at]));
        const auto most = std::max_element(shared.begin(), shared.end());
        while (first_left < done.size() && done[first_left])
            ++first_left;
        at = *most > 0 ? static_cast<std::size_t>(most - shared.begin()) : first_left;
    }
    return result;
}

} // namespace

std::vector<WorkUnit> make_work_units(const StoredParts& stored, std::vector<IndexPair> pairs,
                                      std::uint64_t budget, WorkOrder order,
                                      const std::string& store) {
    Partition partition(stored, budget, store);
    if (order == WorkOrder::random) {
        std::shuffle(pairs.begin(), pairs.end(), std::mt19937_64(1));
        partition.fill_in_order(pairs);
        return partition.take();
    }
    partition.cut(std::move(pairs));
    return in_order_of_sharing(partition.take(), stored);
}

} // namespace abut
