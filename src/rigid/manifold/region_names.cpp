#include "rigid/manifold/region_names.h"

#include "math/vector.h"
#include "rigid/manifold/triangle_meeting.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace abut {

namespace {

constexpr double kCosOfSame = 0.5;

Vec3 middle_of(const ModelManifold& m) {
    Vec3 sum;
    for (std::uint32_t i = 0; i < m.count; ++i)
        sum = sum + 0.5 * (m.points[i].point_a + m.points[i].point_b);
    return (1.0 / std::max(m.count, 1U)) * sum;
}

/// A region and one of the last step that may be the same.
struct Match {
    int shared;
    double distance_sq;
    std::size_t now, before;
    /// The best match first.
    bool operator<(const Match& other) const {
        return std::tuple(-shared, distance_sq, now, before) <
               std::tuple(-other.shared, other.distance_sq, other.now, other.before);
    }
};

bool may_be_same(const ModelManifold& now, const ModelManifold& before) {
    return dot(now.normal, before.normal) > kCosOfSame;
}

/// Finds the regions of the last step that share names with those of this one. The middle of a
/// region has the same name in all of them and does not count; nor does a name that many have.
///
/// Cost        that of sorting the names.
std::vector<Match> matches_by_name(const std::vector<ModelManifold>& now,
                                   const std::vector<ModelManifold>& last) {
    constexpr std::ptrdiff_t kMostWithOneName = 32;
    using Named = std::pair<std::uint64_t, std::size_t>; // a name, a region of the last step
    std::vector<Named> names;
    for (std::size_t j = 0; j < last.size(); ++j)
        for (std::uint32_t k = 0; k < last[j].count; ++k)
            if (last[j].points[k].feature != point_name::kMiddle)
                names.emplace_back(last[j].points[k].feature, j);
    std::sort(names.begin(), names.end());
    std::vector<Match> matches;
    std::vector<std::size_t> sharing; // regions, once for each shared name
    for (std::size_t i = 0; i < now.size(); ++i) {
        sharing.clear();
        for (std::uint32_t k = 0; k < now[i].count; ++k) {
            const std::uint64_t name = now[i].points[k].feature;
            const auto begin = std::lower_bound(names.begin(), names.end(), Named{name, 0}),
                       end = std::lower_bound(begin, names.end(), Named{name + 1, 0});
            if (end - begin <= kMostWithOneName)
                std::for_each(begin, end, [&](const Named& n) { sharing.push_back(n.second); });
        }
        std::sort(sharing.begin(), sharing.end());
        for (auto j = sharing.begin(); j != sharing.end();) {
            const auto next = std::upper_bound(j, sharing.end(), *j);
            if (may_be_same(now[i], last[*j]))
                matches.push_back({static_cast<int>(next - j),
                                   length_sq(middle_of(now[i]) - middle_of(last[*j])), i, *j});
            j = next;
        }
    }
    return matches;
}

/// Pairs the regions that have no partner yet. None if that would be too many pairs.
std::vector<Match> matches_by_distance(const std::vector<ModelManifold>& now,
                                       const std::vector<bool>& named,
                                       const std::vector<ModelManifold>& last,
                                       const std::vector<bool>& used) {
    constexpr std::size_t kMostPairs = std::size_t{1} << 20U;
    const auto unset = [](const std::vector<bool>& flags) {
        return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), false));
    };
    std::vector<Match> matches;
    if (unset(used) == 0 || unset(named) > kMostPairs / unset(used))
        return matches;
    for (std::size_t i = 0; i < now.size(); ++i)
        for (std::size_t j = 0; !named[i] && j < last.size(); ++j)
            if (!used[j] && may_be_same(now[i], last[j]))
                matches.push_back({0, length_sq(middle_of(now[i]) - middle_of(last[j])), i, j});
    return matches;
}

} // namespace

void name_regions(std::vector<ModelManifold>& manifolds, const std::vector<ModelManifold>* last) {
    if (manifolds.size() == 1 && (last == nullptr || last->size() <= 1)) {
        const bool stays =
            last != nullptr && !last->empty() && may_be_same(manifolds[0], last->front());
        manifolds[0].region = stays ? last->front().region : 0;
        return;
    }
    std::vector<bool> named(manifolds.size());
    std::vector<std::uint32_t> taken;
    if (last != nullptr) {
        std::vector<bool> used(last->size());
        const auto name_by = [&](std::vector<Match> matches) {
            std::sort(matches.begin(), matches.end());
            for (const Match& match : matches) {
                if (named[match.now] || used[match.before])
                    continue;
                named[match.now] = used[match.before] = true;
                manifolds[match.now].region = (*last)[match.before].region;
                taken.push_back(manifolds[match.now].region);
            }
        };
        name_by(matches_by_name(manifolds, *last));
        name_by(matches_by_distance(manifolds, named, *last, used));
    }
    std::sort(taken.begin(), taken.end());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < manifolds.size(); ++i) {
        if (named[i])
            continue;
        while (std::binary_search(taken.begin(), taken.end(), next))
            ++next;
        manifolds[i].region = next++;
    }
    std::sort(manifolds.begin(), manifolds.end(),
              [](const ModelManifold& m, const ModelManifold& n) { return m.region < n.region; });
}

} // namespace abut
