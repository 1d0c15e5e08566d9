#include "rigid/model/clean_surface.h"

#include "core/disjoint_sets.h"
#include "rigid/model/surface_edges.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace abut {

namespace {

constexpr std::uint32_t kNoGroup = ~std::uint32_t{0};

/// A triangle by its merged vertices, turned so that the least comes first.
struct Turned {
    std::array<std::uint32_t, 3> sorted{}; ///< the vertices in ascending order
    bool reversed = false;                 ///< they run the other way in the triangle
    std::uint32_t triangle = 0;

    [[nodiscard]] bool same_positions(const Turned& t) const { return sorted == t.sorted; }
    friend bool operator<(const Turned& s, const Turned& t) {
        return std::tie(s.sorted, s.reversed, s.triangle) <
               std::tie(t.sorted, t.reversed, t.triangle);
    }
};

Turned turned(const Mesh& mesh, const Topology& topology, std::uint32_t triangle) {
    Turned t;
    t.triangle = triangle;
    for (std::size_t k = 0; k < 3; ++k)
        t.sorted.at(k) = topology.vertex_of[mesh.triangles[triangle].at(k)];
    std::size_t swaps = 0;
    const auto order = [&](std::size_t i, std::size_t j) {
        if (t.sorted.at(j) < t.sorted.at(i))
            std::swap(t.sorted.at(i), t.sorted.at(j)), ++swaps;
    };
    order(0, 1), order(1, 2), order(0, 1);
    t.reversed = swaps % 2 != 0;
    return t;
}

class Cleaning {
public:
    Cleaning(const Mesh& mesh, const Topology& topology)
        : mesh_(mesh), topology_(topology), edges_(mesh, topology),
          group_of_(mesh.triangles.size(), kNoGroup), reversed_(mesh.triangles.size()) {}

    CleanSurface run() {
        find_duplicates();
        drop_closed_copies();
        drop_copies_at_borders();
        CleanSurface result;
        const std::vector<bool> copies = edges_.dropped();
        peel(result);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const bool has_edges = !edges_.edges_of(t).empty();
            result.closed |= has_edges && !edges_.is_dropped(t);
            result.has_sheets |= edges_.is_dropped(t) && !copies[t];
        }
        if (std::ranges::find(edges_.dropped(), true) != edges_.dropped().end())
            result.dropped = edges_.dropped();
        return result;
    }

private:
    /// Groups triangles of the same positions.
    void find_duplicates() {
        std::vector<Turned> all;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (!edges_.edges_of(t).empty())
                all.push_back(turned(mesh_, topology_, t));
        std::sort(all.begin(), all.end());
        for (std::size_t i = 1; i < all.size(); ++i) {
            if (!all[i].same_positions(all[i - 1]))
                continue;
            if (group_of_[all[i - 1].triangle] == kNoGroup) {
                group_of_[all[i - 1].triangle] = static_cast<std::uint32_t>(left_.size());
                reversed_[all[i - 1].triangle] = all[i - 1].reversed;
                left_.emplace_back();
                ++left_.back().at(all[i - 1].reversed ? 1 : 0);
            }
            group_of_[all[i].triangle] = static_cast<std::uint32_t>(left_.size() - 1);
            reversed_[all[i].triangle] = all[i].reversed;
            ++left_.back().at(all[i].reversed ? 1 : 0);
            if (all[i].reversed == all[i - 1].reversed)
                extras_.push_back(all[i].triangle);
        }
    }

    void drop_copy(std::uint32_t triangle) {
        edges_.drop(triangle);
        --left_[group_of_[triangle]].at(reversed_[triangle] ? 1 : 0);
    }

    /// Drops further copies of one orientation that form a surface without a border, as those of a
    /// shell that is there twice do.
    void drop_closed_copies() {
        DisjointSets sets(extras_.size());
        std::vector<std::pair<std::uint32_t, std::uint32_t>> by_edge; // edge, index in extras_
        for (std::uint32_t i = 0; i < extras_.size(); ++i)
            for (const std::uint32_t edge : edges_.edges_of(extras_[i]))
                by_edge.emplace_back(edge, i);
        std::sort(by_edge.begin(), by_edge.end());
        for (std::size_t i = 1; i < by_edge.size(); ++i)
            if (by_edge[i].first == by_edge[i - 1].first)
                sets.unite(by_edge[i].second, by_edge[i - 1].second);
        std::vector<bool> has_border(extras_.size());
        for (std::size_t i = 0, end = 0; i < by_edge.size(); i = end) {
            while (end < by_edge.size() && by_edge[end].first == by_edge[i].first)
                ++end;
            if ((end - i) % 2 != 0)
                has_border[sets.root(by_edge[i].second)] = true;
        }
        for (std::uint32_t i = 0; i < extras_.size(); ++i)
            if (!has_border[sets.root(i)])
                drop_copy(extras_[i]);
    }

    /// Drops copies at edges where the surface has a border, until none helps.
    void drop_copies_at_borders() {
        if (left_.empty())
            return;
        std::vector<std::uint32_t> waiting;
        for (std::uint32_t edge = edges_.size(); edge-- > 0;)
            if (!edges_.is_closed_at(edge))
                waiting.push_back(edge);
        while (!waiting.empty()) {
            const std::uint32_t edge = waiting.back();
            waiting.pop_back();
            if (edges_.is_closed_at(edge))
                continue;
            const std::uint32_t copy = copy_to_drop(edge);
            if (copy == kNoGroup)
                continue;
            drop_copy(copy);
            for (const std::uint32_t next : edges_.edges_of(copy))
                waiting.push_back(next);
        }
    }

    /// Returns a triangle at an edge that runs in the direction that is used too often, and of which
    /// there is another copy; rather one of the same orientation. kNoGroup if there is none.
    [[nodiscard]] std::uint32_t copy_to_drop(std::uint32_t edge) const {
        std::uint32_t reversed_copy = kNoGroup;
        const bool upwards = edges_.excess(edge) > 0;
        for (const HalfEdge& e : edges_.uses(edge)) {
            const std::uint32_t group = group_of_[e.triangle];
            if (group == kNoGroup || edges_.is_dropped(e.triangle) || (e.from < e.to) != upwards)
                continue;
            const auto& left = left_[group];
            if (left.at(reversed_[e.triangle] ? 1 : 0) > 1)
                return e.triangle;
            if (left[0] + left[1] > 1)
                reversed_copy = e.triangle;
        }
        return reversed_copy;
    }

    /// Drops what hangs by an edge in components that have a border, and the whole component if it
    /// has one then, too.
    void peel(CleanSurface& result) {
        const auto triangles = static_cast<std::uint32_t>(mesh_.triangles.size());
        DisjointSets sets(triangles);
        std::vector<std::uint32_t> free;
        const auto last_use = [&](std::uint32_t edge) {
            for (const HalfEdge& e : edges_.uses(edge))
                if (!edges_.is_dropped(e.triangle))
                    return e.triangle;
            return kNoGroup;
        };
        for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) {
            const std::uint32_t first = last_use(edge);
            if (edges_.use_count(edge) == 1)
                free.push_back(edge);
            for (const HalfEdge& e : edges_.uses(edge))
                if (!edges_.is_dropped(e.triangle))
                    sets.unite(first, e.triangle);
        }
        const std::vector<bool> before = edges_.dropped();
        while (!free.empty()) {
            const std::uint32_t edge = free.back();
            free.pop_back();
            if (edges_.use_count(edge) != 1)
                continue;
            const std::uint32_t t = last_use(edge);
            edges_.drop(t);
            for (const std::uint32_t next : edges_.edges_of(t))
                if (edges_.use_count(next) == 1)
                    free.push_back(next);
        }
        std::vector<bool> is_open(triangles), has_rest(triangles);
        for (std::uint32_t t = 0; t < triangles; ++t)
            for (const std::uint32_t edge : edges_.edges_of(t))
                if (!edges_.is_dropped(t)) {
                    has_rest[sets.root(t)] = true;
                    if (!edges_.is_closed_at(edge))
                        is_open[sets.root(t)] = true;
                }
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const std::uint32_t root = sets.root(t);
            if (before[t] || edges_.edges_of(t).empty() || (!is_open[root] && has_rest[root]))
                continue;
            edges_.drop(t);
            result.open.push_back(t);
        }
    }

    const Mesh& mesh_;
    const Topology& topology_;
    SurfaceEdges edges_;
    std::vector<std::uint32_t> group_of_;            ///< by triangle, of those with copies
    std::vector<bool> reversed_;                     ///< by triangle: as Turned::reversed
    std::vector<std::array<std::uint32_t, 2>> left_; ///< by group: how many of each orientation
    std::vector<std::uint32_t> extras_;              ///< all but the first of an orientation
};

} // namespace

CleanSurface clean_surface(const Mesh& mesh, const Topology& topology) {
    return Cleaning(mesh, topology).run();
}

} // namespace abut
