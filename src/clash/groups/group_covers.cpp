#include "clash/groups/group_covers.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

/// A candidate for the next cover. `count` is an upper bound: counts only become smaller.
struct CoverCandidate {
    std::uint32_t count = 0, place = 0;
    /// Returns whether the other comes first: with more clashes or, of equals, with the smaller
    /// place.
    friend bool operator<(const CoverCandidate& a, const CoverCandidate& b) {
        return a.count != b.count ? a.count < b.count : a.place > b.place;
    }
};

/// Points in a grid of cubes whose edge is the reach.
class PlaceGrid {
public:
    PlaceGrid(const GroupFacts& facts, const std::vector<std::uint32_t>& clashes, double reach)
        : facts_(facts), clashes_(clashes), reach_(reach) {
        for (std::uint32_t i = 0; i < clashes.size(); ++i)
            cells_[cell_of(point(i))].push_back(i);
    }

    /// The number of points in the cubes around a point, which is at least that within reach.
    [[nodiscard]] std::uint32_t count_around(std::uint32_t i) const {
        std::size_t count = 0;
        for_each_cell(point(i), [&](const auto& cell) { count += cell.size(); });
        return static_cast<std::uint32_t>(count);
    }

    /// The places of the points within reach of a point that are not removed yet.
    [[nodiscard]] std::vector<std::uint32_t> within_reach(std::uint32_t i) const {
        std::vector<std::uint32_t> result;
        for_each_cell(point(i), [&](const auto& cell) {
            for (const std::uint32_t j : cell)
                if (symmetric_distance_sq(point(i), point(j)) <= reach_ * reach_)
                    result.push_back(j);
        });
        std::ranges::sort(result);
        return result;
    }

    void remove(std::uint32_t i) { std::erase(cells_.at(cell_of(point(i))), i); }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t hash = 0;
            for (const std::int64_t c : cell)
                hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U;
            return static_cast<std::size_t>(hash ^ hash >> 32);
        }
    };

    [[nodiscard]] const Vec3& point(std::uint32_t i) const {
        return facts_.clashes[clashes_[i]].point;
    }
    [[nodiscard]] Cell cell_of(const Vec3& p) const {
        constexpr double kFar = 1e15; // keeps the conversion defined for any point
        const auto index = [&](double v) {
            return static_cast<std::int64_t>(std::clamp(std::floor(v / reach_), -kFar, kFar));
        };
        return {index(p.x), index(p.y), index(p.z)};
    }
    template <typename Take>
    void for_each_cell(const Vec3& p, const Take& take) const {
        const Cell middle = cell_of(p);
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto found = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z});
                    if (found != cells_.end())
                        take(found->second);
                }
    }

    const GroupFacts& facts_;
    const std::vector<std::uint32_t>& clashes_;
    double reach_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

} // namespace

std::vector<Cover> cover_by_part(const GroupFacts& facts, std::vector<std::uint32_t>& clashes,
                                 std::uint32_t least) {
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> of_part;
    for (const std::uint32_t clash : clashes)
        for (const std::uint32_t part : facts.clashes[clash].part)
            of_part[part].push_back(clash);
    std::unordered_map<std::uint32_t, std::uint32_t> left;
    std::priority_queue<CoverCandidate> queue;
    for (const auto& [part, members] : of_part) {
        left[part] = static_cast<std::uint32_t>(members.size());
        if (members.size() >= least)
            queue.push({left[part], part});
    }
    std::vector<bool> is_taken(facts.clashes.size());
    std::vector<Cover> covers;
    while (!queue.empty()) {
        const CoverCandidate best = queue.top();
        queue.pop();
        const std::uint32_t count = left[best.place];
        if (count < best.count) {
            if (count >= least)
                queue.push({count, best.place});
            continue;
        }
        Cover& cover = covers.emplace_back(Cover{best.place, {}});
        for (const std::uint32_t clash : of_part[best.place]) {
            if (is_taken[clash])
                continue;
            is_taken[clash] = true;
            cover.members.push_back(clash);
            for (const std::uint32_t part : facts.clashes[clash].part)
                --left[part];
        }
    }
    std::erase_if(clashes, [&](std::uint32_t clash) { return is_taken[clash]; });
    return covers;
}

std::vector<Cover> cover_by_place(const GroupFacts& facts,
                                  const std::vector<std::uint32_t>& clashes, double reach) {
    PlaceGrid grid(facts, clashes, reach);
    std::priority_queue<CoverCandidate> queue;
    for (std::uint32_t i = 0; i < clashes.size(); ++i)
        queue.push({grid.count_around(i), i});
    std::vector<bool> is_taken(clashes.size());
    std::vector<Cover> covers;
    SearchSteps steps;
    while (!queue.empty()) {
        (void)steps.take();
        const CoverCandidate best = queue.top();
        queue.pop();
        if (is_taken[best.place])
            continue;
        const std::vector<std::uint32_t> members = grid.within_reach(best.place);
        if (members.size() < best.count) {
            queue.push({static_cast<std::uint32_t>(members.size()), best.place});
            continue;
        }
        Cover& cover = covers.emplace_back(Cover{clashes[best.place], {}});
        for (const std::uint32_t i : members) {
            is_taken[i] = true;
            grid.remove(i);
            cover.members.push_back(clashes[i]);
        }
    }
    return covers;
}

} // namespace abut
