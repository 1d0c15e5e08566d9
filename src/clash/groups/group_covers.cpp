#include "clash/groups/group_covers.h"

#include "clash/groups/point_grid.h"
#include "core/stop.h"

#include <algorithm>
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

/// The clashes that are left to be covered, by their places.
class ClashesInReach {
public:
    ClashesInReach(const GroupFacts& facts, const std::vector<std::uint32_t>& clashes, double reach)
        : facts_(facts), clashes_(clashes), reach_(reach), grid_(reach) {
        for (std::uint32_t i = 0; i < clashes.size(); ++i)
            grid_.add(i, point(i));
    }

    /// The number of clashes in the cubes around a clash, which is at least that within reach.
    [[nodiscard]] std::uint32_t count_around(std::uint32_t i) const {
        std::size_t count = 0;
        grid_.for_each_cell(point(i), [&](const auto& cell) { count += cell.size(); });
        return static_cast<std::uint32_t>(count);
    }

    /// The places of the clashes within reach of a clash that are not removed yet.
    [[nodiscard]] std::vector<std::uint32_t> within_reach(std::uint32_t i) const {
        std::vector<std::uint32_t> result;
        grid_.for_each_cell(point(i), [&](const auto& cell) {
            for (const std::uint32_t j : cell)
                if (symmetric_distance_sq(point(i), point(j)) <= reach_ * reach_)
                    result.push_back(j);
        });
        std::ranges::sort(result);
        return result;
    }

    void remove(std::uint32_t i) { grid_.remove(i, point(i)); }

private:
    [[nodiscard]] const Vec3& point(std::uint32_t i) const {
        return facts_.clashes[clashes_[i]].point;
    }

    const GroupFacts& facts_;
    const std::vector<std::uint32_t>& clashes_;
    double reach_;
    PointGrid grid_;
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
    ClashesInReach grid(facts, clashes, reach);
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
