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
            if (copies[t])
                result.copies.push_back(t);
            else
                result.has_sheets |= edges_.is_dropped(t);
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
                left_.emplace_back(), members_.emplace_back();
                add_member(all[i - 1]);
            }
            add_member(all[i]);
            if (all[i].reversed == all[i - 1].reversed)
                extras_.push_back(all[i].triangle);
        }
    }

    /// Adds a triangle to the last group.
    void add_member(const Turned& t) {
        group_of_[t.triangle] = static_cast<std::uint32_t>(left_.size() - 1);
        reversed_[t.triangle] = t.reversed;
        ++left_.back().at(t.reversed ? 1 : 0);
        members_.back().push_back(t.triangle);
    }

    void drop_copy(std::uint32_t triangle) {
        edges_.drop(triangle);
        --left_[group_of_[triangle]].at(reversed_[triangle] ? 1 : 0);
    }

    /// +1 if a triangle runs upwards along an edge, -1 if downwards.
    [[nodiscard]] int direction_at(std::uint32_t edge, std::uint32_t triangle) const {
        for (const HalfEdge& use : edges_.uses(edge))
            if (use.triangle == triangle)
                return use.from < use.to ? 1 : -1;
        return 0;
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
            int excess = 0;
            for (; end < by_edge.size() && by_edge[end].first == by_edge[i].first; ++end)
                excess += direction_at(by_edge[end].first, extras_[by_edge[end].second]);
            // Two neighbours may be oriented against each other, but two copies are no neighbours.
            const bool neighbours = end - i == 2 && group_of_[extras_[by_edge[i].second]] !=
                                                        group_of_[extras_[by_edge[i + 1].second]];
            if (excess != 0 && !neighbours)
                has_border[sets.root(by_edge[i].second)] = true;
        }
        for (std::uint32_t i = 0; i < extras_.size(); ++i)
            if (!has_border[sets.root(i)])
                drop_copy(extras_[i]);
    }

    /// Drops copies so that the surface around them has no border. At an edge of one group of copies
    /// whose number is not decided, the other triangles decide it: as many must run in its direction
    /// as in the other. So groups are decided from the rim of copies inwards.
    void drop_copies_at_borders() {
        undecided_.assign(edges_.size(), 0);
        is_decided_.assign(left_.size(), false);
        std::vector<std::uint32_t> waiting, all;
        for (const std::vector<std::uint32_t>& group : members_)
            for (const std::uint32_t edge : edges_.edges_of(group[0]))
                ++undecided_[edge], all.push_back(edge);
        for (const std::uint32_t edge : all)
            if (undecided_[edge] == 1)
                waiting.push_back(edge);
        std::size_t next = 0; // in `all`: what none decides is decided where there is a border
        while (true) {
            for (; waiting.empty() && next < all.size(); ++next)
                if (undecided_[all[next]] > 0 && !edges_.is_closed_at(all[next]))
                    waiting.push_back(all[next]);
            if (waiting.empty())
                return;
            const std::uint32_t edge = waiting.back();
            waiting.pop_back();
            if (undecided_[edge] > 0)
                decide_at(edge, waiting);
        }
    }

    /// Decides the first group of copies at an edge that is not decided. If there are others, one copy
    /// is kept.
    void decide_at(std::uint32_t edge, std::vector<std::uint32_t>& waiting) {
        for (const HalfEdge& use : edges_.uses(edge)) {
            const std::uint32_t group = group_of_[use.triangle];
            if (group == kNoGroup || is_decided_[group])
                continue;
            is_decided_[group] = true;
            // The direction of copies that are not reversed.
            const int direction = (use.from < use.to) != reversed_[use.triangle] ? 1 : -1;
            const auto [ahead, back] = left_[group];
            const int net = static_cast<int>(ahead) - static_cast<int>(back);
            const bool is_told = undecided_[edge] == 1;
            const int one = ahead == 0 ? -1 : back == 0 ? 1 : net;
            keep(group, net, is_told ? net - direction * edges_.excess(edge) : one);
            for (const std::uint32_t other : edges_.edges_of(use.triangle))
                if (--undecided_[other] == 1)
                    waiting.push_back(other);
            return;
        }
    }

    /// Drops copies of a group so that `wanted` more run ahead than back, or as near to that as is
    /// possible with a copy left; now `net` more do.
    void keep(std::uint32_t group, int net, int wanted) {
        if (wanted == net)
            return;
        auto left = left_[group];
        const std::uint32_t both = std::min(left[0], left[1]);
        if (wanted > 0 && left[0] > 0)
            left = {std::min(left[0], static_cast<std::uint32_t>(wanted)), 0};
        else if (wanted < 0 && left[1] > 0)
            left = {0, std::min(left[1], static_cast<std::uint32_t>(-wanted))};
        else
            left = {std::max(both, left[0] > 0 && left[1] == 0 ? 1U : 0U),
                    std::max(both, left[1] > 0 && left[0] == 0 ? 1U : 0U)};
        if (left[0] + left[1] == 0)
            return;
        for (std::size_t i = members_[group].size(); i-- > 0;) { // the last copies go
            const std::uint32_t t = members_[group][i];
            const std::size_t side = reversed_[t] ? 1 : 0;
            if (!edges_.is_dropped(t) && left_[group].at(side) > left.at(side))
                drop_copy(t);
        }
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
            if (before[t] || edges_.edges_of(t).empty())
                continue;
            if (is_open[root] || !has_rest[root]) {
                edges_.drop(t);
                result.open.push_back(t);
            } else if (edges_.is_dropped(t)) {
                result.hanging.push_back(t);
            }
        }
    }

    const Mesh& mesh_;
    const Topology& topology_;
    SurfaceEdges edges_;
    std::vector<std::uint32_t> group_of_;             ///< by triangle, of those with copies
    std::vector<bool> reversed_;                      ///< by triangle: as Turned::reversed
    std::vector<std::array<std::uint32_t, 2>> left_;  ///< by group: how many of each orientation
    std::vector<std::vector<std::uint32_t>> members_; ///< by group
    std::vector<std::uint32_t> extras_;               ///< all but the first of an orientation
    std::vector<std::uint32_t> undecided_;            ///< by edge: groups that are not decided
    std::vector<bool> is_decided_;                    ///< by group
};

} // namespace

CleanSurface clean_surface(const Mesh& mesh, const Topology& topology) {
    return Cleaning(mesh, topology).run();
}

} // namespace abut
