// Groups of clashes against a direct implementation of their definition, and under permutations of
// files, parts and sides.

#include <abut/clash.h>
#include <abut/clash_groups.h>

#include "tests/support/clash/grouped_clashes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace abut::test {
namespace {

using Ids = std::set<std::string>; ///< keys of clashes: both part keys, joined

/// A clash by its parts' keys, smaller first. The tests have at most one clash for each pair.
struct Pair {
    std::string a, b;
    std::uint64_t id;
    ClashKind kind;
    Vec3 point;
    [[nodiscard]] std::string key() const { return a + "|" + b; }
};

std::vector<Pair> pairs_of(const GroupedClashes& all) {
    std::vector<Pair> pairs;
    for (const Clash& clash : all.report.clashes) {
        std::array<std::string, 2> keys;
        for (std::size_t side = 0; side < 2; ++side) {
            const Scene& scene = all.models[clash.model.at(side)];
            keys.at(side) = scene.file + "/" + scene.parts[clash.part.at(side)].id;
        }
        std::ranges::sort(keys);
        const Vec3 point{0.5 * (clash.point_a.x + clash.point_b.x),
                         0.5 * (clash.point_a.y + clash.point_b.y),
                         0.5 * (clash.point_a.z + clash.point_b.z)};
        pairs.push_back({keys[0], keys[1], clash.id, clash.kind, point});
    }
    std::ranges::sort(pairs, {}, [](const Pair& pair) { return std::pair(pair.id, pair.key()); });
    return pairs;
}

/// The sets of members of all innermost groups.
std::set<Ids> members_of(const GroupedClashes& all, const std::vector<ClashGroup>& groups) {
    std::set<Ids> result;
    for (const ClashGroup* group : innermost_groups(groups)) {
        Ids ids;
        for (const std::uint32_t i : group->clashes) {
            GroupedClashes one{all.models, {}};
            one.report.clashes = {all.report.clashes[i]};
            ids.insert(pairs_of(one)[0].key());
        }
        result.insert(ids);
    }
    return result;
}

/// Takes the largest of the sets that `shares` describes, again and again.
template <typename Key, typename Members>
std::set<Ids> greedily(std::vector<Pair>& left, const std::vector<Key>& keys, std::size_t least,
                       const Members& is_member) {
    std::set<Ids> result;
    while (true) {
        const Key* best = nullptr;
        std::size_t most = 0;
        for (const Key& key : keys) {
            const auto count = static_cast<std::size_t>(std::ranges::count_if(
                left, [&](const Pair& pair) { return is_member(key, pair); }));
            if (count > most)
                best = &key, most = count;
        }
        if (best == nullptr || most < least)
            return result;
        Ids ids;
        std::erase_if(left, [&](const Pair& pair) {
            const bool in = is_member(*best, pair);
            if (in)
                ids.insert(pair.key());
            return in;
        });
        result.insert(ids);
    }
}

/// Connected components of duplicates.
std::set<Ids> sets_of_copies(std::vector<Pair>& left) {
    std::vector<std::pair<std::set<std::string>, Ids>> sets;
    for (const Pair& pair : left) {
        if (pair.kind != ClashKind::duplicate)
            continue;
        std::pair<std::set<std::string>, Ids> joined{{pair.a, pair.b}, {pair.key()}};
        std::erase_if(sets, [&](const auto& set) {
            const bool meets = set.first.contains(pair.a) || set.first.contains(pair.b);
            if (meets) {
                joined.first.insert(set.first.begin(), set.first.end());
                joined.second.insert(set.second.begin(), set.second.end());
            }
            return meets;
        });
        sets.push_back(joined);
    }
    std::erase_if(left, [](const Pair& pair) { return pair.kind == ClashKind::duplicate; });
    std::set<Ids> result;
    for (const auto& set : sets)
        result.insert(set.second);
    return result;
}

std::set<Ids> parts_directly(std::vector<Pair>& left, std::size_t least) {
    std::set<std::string> keys;
    for (const Pair& pair : left)
        keys.insert({pair.a, pair.b});
    const std::vector<std::string> sorted(keys.begin(), keys.end());
    return greedily(left, sorted, least, [](const std::string& key, const Pair& pair) {
        return pair.a == key || pair.b == key;
    });
}

std::set<Ids> places_directly(std::vector<Pair>& left, double reach) {
    const std::vector<Pair> centres = left;
    std::set<std::string> gone;
    std::set<Ids> result;
    while (!left.empty()) {
        const std::vector<Pair> keys = left;
        // One step at a time, since a centre must still be there.
        const Pair* best = nullptr;
        std::size_t most = 0;
        const auto near = [&](const Pair& centre, const Pair& pair) {
            const double dx = centre.point.x - pair.point.x, dy = centre.point.y - pair.point.y,
                         dz = centre.point.z - pair.point.z;
            return dx * dx + dy * dy + dz * dz <= reach * reach;
        };
        for (const Pair& key : keys) {
            const auto count = static_cast<std::size_t>(
                std::ranges::count_if(left, [&](const Pair& pair) { return near(key, pair); }));
            if (count > most)
                best = &key, most = count;
        }
        Ids ids;
        std::erase_if(left, [&](const Pair& pair) {
            const bool in = near(*best, pair);
            if (in)
                ids.insert(pair.key());
            return in;
        });
        result.insert(ids);
    }
    return result;
}

TEST(ClashGroups, AreThoseOfTheDefinition) {
    Random random(20);
    int shared = 0, places = 0, copies = 0, rounds = 0;
    for (int round = 0; round < many(60); ++round, ++rounds) {
        const GroupedClashes all = some_clashes(random, random.integer(1, 80));
        GroupOptions options;
        options.least = static_cast<std::uint32_t>(random.integer(2, 5));
        options.reach = random.uniform(0.5, 6);
        std::vector<Pair> left = pairs_of(all);
        std::set<Ids> expected = sets_of_copies(left);
        copies += static_cast<int>(expected.size());
        for (const Ids& ids : parts_directly(left, options.least))
            expected.insert(ids), ++shared;
        for (const Ids& ids : places_directly(left, options.reach))
            expected.insert(ids), ++places;
        EXPECT_EQ(members_of(all, group_clashes(all.report, all.models, options)), expected);

        options.by = {GroupBy::part};
        left = pairs_of(all);
        expected = sets_of_copies(left);
        expected.merge(parts_directly(left, 1));
        EXPECT_EQ(members_of(all, group_clashes(all.report, all.models, options)), expected);
    }
    EXPECT_GT(shared, rounds);
    EXPECT_GT(places, rounds);
    EXPECT_GT(copies, rounds);
}

/// Every clash is in exactly one innermost group, and a group holds the clashes of its groups.
void expect_partition(const ClashReport& report, const std::vector<ClashGroup>& groups) {
    std::vector<int> times(report.clashes.size());
    for (const ClashGroup* group : innermost_groups(groups))
        for (const std::uint32_t i : group->clashes)
            ++times.at(i);
    EXPECT_TRUE(std::ranges::all_of(times, [](int n) { return n == 1; }));
    for (const ClashGroup& group : groups) {
        if (group.groups.empty())
            continue;
        std::vector<std::uint32_t> inner;
        for (const ClashGroup& g : group.groups)
            inner.insert(inner.end(), g.clashes.begin(), g.clashes.end());
        std::ranges::sort(inner);
        EXPECT_EQ(inner, group.clashes);
    }
}

void collect_names(const GroupedClashes& all, const std::vector<ClashGroup>& groups,
                   std::vector<std::string>& lines) {
    for (const ClashGroup& group : groups) {
        std::string line = group.id + " " + group.name + " " + group.what + " " + group.key;
        std::set<std::uint64_t> ids;
        for (const std::uint32_t i : group.clashes)
            ids.insert(all.report.clashes[i].id);
        for (const std::uint64_t id : ids)
            line += " " + clash_id_text(id);
        lines.push_back(line);
        collect_names(all, group.groups, lines);
    }
}

TEST(ClashGroups, DoNotDependOnTheOrderOfFilesPartsAndSides) {
    Random random(21);
    const std::vector<const char*> groupings{
        "part,place",       "part",        "place",
        "storey,part",      "types",       "system",
        "discipline,types", "place,types", "storey,place,part"};
    for (int round = 0; round < many(40); ++round) {
        const GroupedClashes all = some_clashes(random, random.integer(1, 60));
        const GroupedClashes other = permuted(random, all);
        for (const char* const by : groupings) {
            GroupOptions options;
            options.by = parse_grouping(by);
            std::vector<std::string> lines, others;
            const auto groups = group_clashes(all.report, all.models, options);
            collect_names(all, groups, lines);
            collect_names(other, group_clashes(other.report, other.models, options), others);
            ASSERT_EQ(lines, others) << by;
            expect_partition(all.report, groups);
            std::set<std::string> ids;
            for (const std::string& line : lines)
                EXPECT_TRUE(ids.insert(line.substr(0, 16)).second) << "an id is there twice";
        }
    }
}

/// The innermost groups as a later grouping knows them.
void remember(const GroupedClashes& all, const std::vector<ClashGroup>& groups,
              const std::string& parent, std::vector<EarlierGroup>& earlier) {
    for (const ClashGroup& group : groups) {
        remember(all, group.groups, group.id, earlier);
        if (!group.groups.empty())
            continue;
        auto known = std::ranges::find(earlier, group.id, &EarlierGroup::id);
        if (known == earlier.end())
            known = earlier.insert(
                earlier.end(),
                {group.id, parent, group.name, group.kind, group.key, group.centre, {}});
        for (const std::uint32_t i : group.clashes)
            if (std::ranges::find(known->clashes, all.report.clashes[i].id) == known->clashes.end())
                known->clashes.push_back(all.report.clashes[i].id);
    }
}

TEST(ClashGroups, KeepTheirClashesFromJobToJob) {
    Random random(22);
    int stayed = 0, joined = 0, opened = 0;
    for (int round = 0; round < many(40); ++round) {
        GroupedClashes all = some_clashes(random, random.integer(10, 60));
        GroupOptions options;
        options.by = parse_grouping(random.chance(0.5) ? "part,place" : "storey,part");
        std::map<std::uint64_t, std::string> group_of;
        for (int job = 0; job < 5; ++job) {
            GroupedClashes now = all;
            std::erase_if(now.report.clashes, [&](const Clash&) { return random.chance(0.3); });
            now = permuted(random, now);
            const auto groups = group_clashes(now.report, now.models, options);
            expect_partition(now.report, groups);
            std::set<std::string> known;
            for (const EarlierGroup& group : options.earlier)
                known.insert(group.id);
            std::set<std::string> distinct;
            for (const ClashGroup* group : innermost_groups(groups)) {
                EXPECT_TRUE(distinct.insert(group->id).second);
                for (const std::uint32_t i : group->clashes) {
                    const std::uint64_t id = now.report.clashes[i].id;
                    if (const auto found = group_of.find(id); found != group_of.end()) {
                        // Sets of copies may be split or joined.
                        if (now.report.clashes[i].kind != ClashKind::duplicate) {
                            EXPECT_EQ(found->second, group->id);
                        }
                        ++stayed;
                    } else {
                        ++(known.contains(group->id) ? joined : opened);
                    }
                    group_of[id] = group->id;
                }
            }
            for (EarlierGroup& group : options.earlier) // a clash is in the group it was in last
                std::erase_if(group.clashes,
                              [&](std::uint64_t id) { return group_of.at(id) != group.id; });
            remember(now, groups, {}, options.earlier);
        }
    }
    EXPECT_GT(stayed, 100);
    EXPECT_GT(joined, 10);
    EXPECT_GT(opened, 10);
}

/// Points on a lattice, so that equal distances and distances of exactly the reach are frequent.
Vec3 lattice_point(Random& random, int half) {
    const auto step = [&] { return 0.5 * random.integer(-half, half); };
    const double x = step(), y = step(), z = step();
    return {x, y, z};
}

TEST(ClashGroups, JoinTheNearestEarlierPlace) {
    Random random(23);
    int joined = 0, ties = 0, at_reach = 0, none = 0;
    for (int round = 0; round < many(60); ++round) {
        const Vec3 far = random.chance(0.3) ? Vec3{4.5e6, -3.1e5, 12.75} : Vec3{};
        const int half = random.integer(3, 30);
        GroupedClashes all = some_clashes(random, 60);
        std::erase_if(all.report.clashes,
                      [](const Clash& clash) { return clash.kind == ClashKind::duplicate; });
        for (Clash& clash : all.report.clashes)
            clash.point_a = clash.point_b = far + lattice_point(random, half);
        GroupOptions options;
        options.by = {GroupBy::place};
        options.reach = 0.5 * random.integer(1, 8);
        for (int i = random.integer(0, 200); i > 0; --i)
            options.earlier.push_back({clash_id_text(1000 + 7919 * static_cast<std::uint64_t>(i)),
                                       {},
                                       "place",
                                       GroupKind::place,
                                       "key",
                                       far + lattice_point(random, half),
                                       {}});
        shuffle(random, options.earlier);
        const auto groups = group_clashes(all.report, all.models, options);
        const auto group_of = [&](std::uint32_t clash) {
            for (const ClashGroup& group : groups)
                if (std::ranges::find(group.clashes, clash) != group.clashes.end())
                    return group.id;
            return std::string();
        };
        for (std::uint32_t c = 0; c < all.report.clashes.size(); ++c) {
            const EarlierGroup* best = nullptr;
            double nearest = options.reach * options.reach;
            for (const EarlierGroup& earlier : options.earlier) {
                const Vec3 d = earlier.centre - all.report.clashes[c].point_a;
                const double distance = d.x * d.x + d.y * d.y + d.z * d.z;
                ties += best != nullptr && distance == nearest ? 1 : 0;
                if (distance < nearest ||
                    (distance == nearest && (best == nullptr || earlier.id < best->id)))
                    best = &earlier, nearest = distance;
            }
            if (best != nullptr) {
                EXPECT_EQ(group_of(c), best->id) << "round " << round << ", clash " << c;
                at_reach += nearest == options.reach * options.reach ? 1 : 0;
                ++joined;
            } else {
                const std::string id = group_of(c);
                EXPECT_TRUE(std::ranges::find(options.earlier, id, &EarlierGroup::id) ==
                            options.earlier.end());
                ++none;
            }
        }
    }
    EXPECT_GT(joined, 200);
    EXPECT_GT(none, 100);
    EXPECT_GT(ties, 50);
    EXPECT_GT(at_reach, 20);
}

} // namespace
} // namespace abut::test
