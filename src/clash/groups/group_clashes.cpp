#include <abut/clash_groups.h>
#include <abut/error.h>

#include "clash/groups/earlier_places.h"
#include "clash/groups/group_covers.h"
#include "clash/groups/group_facts.h"
#include "clash/groups/group_names.h"
#include "clash/report/clash_text.h"
#include "core/stop.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace abut {

namespace {

/// Clashes that stay together: one clash, or the duplicates among parts that duplicate each other.
struct ClashUnit {
    std::vector<std::uint32_t> clashes; ///< sorted by rank
    std::uint32_t part = kNoGroupPart;  ///< of copies: the one with the smallest key
};

GroupKind group_kind_of(GroupBy by) {
    switch (by) {
    case GroupBy::part:
        return GroupKind::part;
    case GroupBy::place:
        return GroupKind::place;
    case GroupBy::storey:
        return GroupKind::storey;
    case GroupBy::system:
        return GroupKind::system;
    case GroupBy::types:
        return GroupKind::types;
    case GroupBy::discipline:
        break;
    }
    return GroupKind::discipline;
}

/// Sets of parts that duplicate each other, directly or through others: connected components.
class CopySets {
public:
    explicit CopySets(const GroupFacts& facts) : root_(facts.parts.size()) {
        std::iota(root_.begin(), root_.end(), 0U);
        for (std::size_t i = 0; i < facts.clashes.size(); ++i)
            if (facts.report.clashes[i].kind == ClashKind::duplicate)
                join(facts.clashes[i].part[0], facts.clashes[i].part[1]);
    }
    /// The part with the smallest key among the copies of a part.
    std::uint32_t first(std::uint32_t part) {
        while (root_[part] != part)
            part = root_[part] = root_[root_[part]];
        return part;
    }

private:
    void join(std::uint32_t a, std::uint32_t b) {
        a = first(a), b = first(b);
        root_[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::uint32_t> root_;
};

class ClashGrouper {
public:
    ClashGrouper(const GroupFacts& facts, const GroupOptions& options)
        : facts_(facts), options_(options) {
        for (const EarlierGroup& group : options.earlier) {
            used_ids_.insert(group.id);
            earlier_by_parent_[group.parent].push_back(&group);
            for (const std::uint64_t clash : group.clashes)
                earlier_of_.emplace(clash, &group);
        }
        for (auto& [parent, groups] : earlier_by_parent_)
            std::ranges::sort(groups, {}, &EarlierGroup::id);
    }

    std::vector<ClashGroup> run() {
        CopySets copies(facts_);
        std::map<std::uint32_t, std::size_t> unit_of;
        std::vector<ClashUnit> units;
        for (const std::uint32_t clash : facts_.order) {
            if (facts_.report.clashes[clash].kind != ClashKind::duplicate) {
                units.push_back({{clash}, kNoGroupPart});
                continue;
            }
            const std::uint32_t part = copies.first(facts_.clashes[clash].part[0]);
            const auto [found, is_new] = unit_of.try_emplace(part, units.size());
            if (is_new)
                units.push_back({{}, part});
            units[found->second].clashes.push_back(clash);
        }
        return divide(std::move(units), 0, {});
    }

private:
    std::vector<ClashGroup> divide(std::vector<ClashUnit> units, std::size_t level,
                                   const std::string& parent) {
        if (level == options_.by.size() || units.empty())
            return {};
        std::vector<ClashGroup> groups;
        switch (options_.by[level]) {
        case GroupBy::part:
            return by_part(std::move(units), level, parent);
        case GroupBy::place:
            return by_place(units, level, parent);
        default:
            return by_property(units, level, parent);
        }
    }

    std::vector<ClashGroup> by_property(std::vector<ClashUnit>& units, std::size_t level,
                                        const std::string& parent) {
        const GroupBy by = options_.by[level];
        const auto less = [](const std::string& a, const std::string& b) {
            return natural_less(a, b);
        };
        std::map<std::string, std::vector<ClashUnit>, decltype(less)> of_value(less);
        for (ClashUnit& unit : units) {
            std::string value = property_of_clash(facts_, unit.clashes.front(), by);
            for (const std::uint32_t clash : unit.clashes)
                value = std::min(value, property_of_clash(facts_, clash, by), natural_less);
            of_value[value].push_back(std::move(unit));
        }
        std::vector<ClashGroup> groups;
        for (auto& [value, members] : of_value) {
            ClashGroup& group = groups.emplace_back();
            group.kind = group_kind_of(by);
            group.key = value;
            group.id = group_id(parent, group.kind, value, 0);
            fill(group, members, kNoGroupPart);
            group.name = group_name(facts_, group);
            group.groups = divide(std::move(members), level + 1, group.id);
        }
        return groups;
    }

    /// Groups of one level and one parent while clashes are assigned to them. Earlier groups come
    /// first, sorted by id; they stay even without members until finish().
    struct Draft {
        ClashGroup group;
        std::vector<ClashUnit> units;
        bool is_new = true;
        std::uint32_t part = kNoGroupPart;
    };

    std::vector<Draft> earlier_drafts(const std::string& parent, bool places) const {
        std::vector<Draft> drafts;
        const auto found = earlier_by_parent_.find(parent);
        if (found == earlier_by_parent_.end())
            return drafts;
        for (const EarlierGroup* earlier : found->second) {
            if ((earlier->kind == GroupKind::place) != places ||
                (!places && earlier->kind != GroupKind::part && earlier->kind != GroupKind::copies))
                continue;
            Draft& draft = drafts.emplace_back();
            draft.group.id = earlier->id;
            draft.group.name = earlier->name;
            draft.group.kind = earlier->kind;
            draft.group.key = earlier->key;
            draft.group.centre = earlier->centre;
            draft.is_new = false;
        }
        return drafts;
    }

    /// The earlier innermost group around which `parent` is, of most of a unit's clashes; of
    /// equals, the one with the smaller id. Null if there is none.
    const EarlierGroup* earlier_group(const ClashUnit& unit, const std::string& parent) const {
        std::map<std::string, std::pair<std::size_t, const EarlierGroup*>> votes;
        for (const std::uint32_t clash : unit.clashes) {
            const auto found = earlier_of_.find(facts_.report.clashes[clash].id);
            if (found != earlier_of_.end() && found->second->parent == parent) {
                auto& [count, group] = votes[found->second->id];
                ++count, group = found->second;
            }
        }
        const auto most =
            std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second.first; });
        return most == votes.end() ? nullptr : most->second.second;
    }

    static Draft* find_draft(std::vector<Draft>& drafts, std::size_t earlier,
                             const std::string& id) {
        const auto end = drafts.begin() + static_cast<std::ptrdiff_t>(earlier);
        const auto found = std::lower_bound(
            drafts.begin(), end, id,
            [](const Draft& draft, const std::string& text) { return draft.group.id < text; });
        return found == end || found->group.id != id ? nullptr : &*found;
    }

    Draft& add_draft(std::vector<Draft>& drafts, const std::string& parent, GroupKind kind,
                     const std::string& key) {
        Draft& draft = drafts.emplace_back();
        draft.group.kind = kind;
        draft.group.key = key;
        std::uint32_t salt = 0;
        do
            draft.group.id = group_id(parent, kind, key, salt++);
        while (!used_ids_.insert(draft.group.id).second);
        return draft;
    }

    std::vector<ClashGroup> by_part(std::vector<ClashUnit> units, std::size_t level,
                                    const std::string& parent);
    std::vector<ClashGroup> by_place(std::vector<ClashUnit>& units, std::size_t level,
                                     const std::string& parent);
    std::vector<ClashUnit> join_earlier_parts(std::vector<ClashUnit>& units,
                                              std::vector<Draft>& drafts, const std::string& parent,
                                              std::vector<ClashUnit>& rest);
    std::vector<ClashUnit> join_earlier_places(std::vector<ClashUnit>& units,
                                               std::vector<Draft>& drafts,
                                               const std::string& parent);
    void add_copies(std::vector<ClashUnit>& units, std::vector<Draft>& drafts, std::size_t earlier,
                    const std::string& parent);

    [[nodiscard]] Vec3 point_of(const ClashUnit& unit) const {
        return facts_.clashes[unit.clashes.front()].point;
    }

    void fill(ClashGroup& group, const std::vector<ClashUnit>& units, std::uint32_t part) const;
    std::vector<ClashGroup> finish(std::vector<Draft>& drafts, std::size_t level, bool divides);

    const GroupFacts& facts_;
    const GroupOptions& options_;
    std::unordered_map<std::string, std::vector<const EarlierGroup*>> earlier_by_parent_;
    std::unordered_map<std::uint64_t, const EarlierGroup*> earlier_of_; ///< by clash id
    std::unordered_set<std::string> used_ids_;
};

void ClashGrouper::fill(ClashGroup& group, const std::vector<ClashUnit>& units,
                        std::uint32_t part) const {
    const std::vector<Clash>& clashes = facts_.report.clashes;
    for (const ClashUnit& unit : units)
        group.clashes.insert(group.clashes.end(), unit.clashes.begin(), unit.clashes.end());
    std::ranges::sort(group.clashes);
    group.deepest = told_distance(clashes[group.clashes.front()]);
    for (const std::uint32_t i : group.clashes) {
        ++group.counts.at(static_cast<std::size_t>(clashes[i].kind));
        group.deepest = std::min(group.deepest, told_distance(clashes[i]));
        for (const Vec3& point : {clashes[i].point_a, clashes[i].point_b}) {
            group.bounds.lower = min(group.bounds.lower, point);
            group.bounds.upper = max(group.bounds.upper, point);
        }
    }
    if (group.kind != GroupKind::place)
        group.centre = 0.5 * (group.bounds.lower + group.bounds.upper);
    if (group.kind == GroupKind::part && part != kNoGroupPart)
        group.part = {facts_.parts[part].model, facts_.parts[part].part};
    group.what = types_in_group(facts_, group, part);
}

std::vector<ClashGroup> ClashGrouper::finish(std::vector<Draft>& drafts, std::size_t level,
                                             bool divides) {
    std::erase_if(drafts, [](const Draft& draft) { return draft.units.empty(); });
    std::ranges::sort(drafts, [&](const Draft& a, const Draft& b) {
        std::size_t m = 0, n = 0;
        for (const ClashUnit& unit : a.units)
            m += unit.clashes.size();
        for (const ClashUnit& unit : b.units)
            n += unit.clashes.size();
        return m != n ? m > n : a.group.id < b.group.id;
    });
    std::vector<ClashGroup> groups;
    std::vector<bool> is_new;
    for (Draft& draft : drafts) {
        ClashGroup& group = groups.emplace_back(std::move(draft.group));
        fill(group, draft.units, draft.part);
        if (draft.is_new)
            group.name = group_name(facts_, group);
        is_new.push_back(draft.is_new);
    }
    distinguish_names(groups, is_new);
    for (std::size_t i = 0; divides && i < groups.size(); ++i)
        groups[i].groups = divide(std::move(drafts[i].units), level + 1, groups[i].id);
    return groups;
}

/// Assigns units to the earlier groups that they or their parts belong to. Returns the others;
/// those that belong to an earlier group of a later criterion go to `rest`.
std::vector<ClashUnit> ClashGrouper::join_earlier_parts(std::vector<ClashUnit>& units,
                                                        std::vector<Draft>& drafts,
                                                        const std::string& parent,
                                                        std::vector<ClashUnit>& rest) {
    const std::size_t earlier = drafts.size();
    std::unordered_map<std::string, Draft*> of_key;
    for (Draft& draft : drafts)
        if (draft.group.kind == GroupKind::part)
            of_key.emplace(draft.group.key, &draft);
    for (auto& [key, draft] : of_key) {
        const auto part = std::ranges::lower_bound(facts_.parts, key, {}, &GroupPart::key);
        if (part != facts_.parts.end() && part->key == key)
            draft->part = static_cast<std::uint32_t>(part - facts_.parts.begin());
    }
    std::vector<ClashUnit> others, left;
    for (ClashUnit& unit : units) {
        const EarlierGroup* group = earlier_group(unit, parent);
        const bool is_copies = unit.part != kNoGroupPart;
        if (group != nullptr && group->kind == (is_copies ? GroupKind::copies : GroupKind::part))
            find_draft(drafts, earlier, group->id)->units.push_back(std::move(unit));
        else if (group != nullptr && !is_copies)
            rest.push_back(std::move(unit));
        else
            others.push_back(std::move(unit));
    }
    // Which of two groups a clash joins depends on the groups before, not on the order of clashes.
    std::unordered_map<Draft*, std::size_t> sizes;
    for (Draft& draft : drafts)
        sizes[&draft] = draft.units.size();
    for (ClashUnit& unit : others) {
        Draft* best = nullptr;
        if (unit.part == kNoGroupPart)
            for (const std::uint32_t part : facts_.clashes[unit.clashes.front()].part) {
                const auto found = of_key.find(facts_.parts[part].key);
                if (found != of_key.end() &&
                    (best == nullptr || sizes[found->second] > sizes[best]))
                    best = found->second;
            }
        (best != nullptr ? best->units : left).push_back(std::move(unit));
    }
    return left;
}

/// Gives each set of copies that has no earlier group a group. Where several sets continue one
/// earlier group, the largest keeps it.
void ClashGrouper::add_copies(std::vector<ClashUnit>& units, std::vector<Draft>& drafts,
                              std::size_t earlier, const std::string& parent) {
    std::vector<ClashUnit> sets;
    for (std::size_t i = 0; i < earlier; ++i) {
        Draft& draft = drafts[i];
        if (draft.group.kind != GroupKind::copies || draft.units.size() < 2)
            continue;
        std::ranges::stable_sort(draft.units, [](const ClashUnit& a, const ClashUnit& b) {
            return a.clashes.size() > b.clashes.size();
        });
        sets.insert(sets.end(), draft.units.begin() + 1, draft.units.end());
        draft.units.resize(1);
    }
    for (ClashUnit& unit : units)
        if (unit.part != kNoGroupPart)
            sets.push_back(std::move(unit));
    std::erase_if(units, [](const ClashUnit& unit) { return unit.clashes.empty(); });
    std::ranges::sort(sets, {}, &ClashUnit::part);
    for (ClashUnit& set : sets)
        add_draft(drafts, parent, GroupKind::copies, facts_.parts[set.part].key)
            .units.push_back(std::move(set));
}

std::vector<ClashGroup> ClashGrouper::by_part(std::vector<ClashUnit> units, std::size_t level,
                                              const std::string& parent) {
    const bool is_last = level + 1 == options_.by.size();
    std::vector<Draft> drafts = earlier_drafts(parent, false);
    const std::size_t earlier = drafts.size();
    std::vector<ClashUnit> rest;
    std::vector<ClashUnit> left = join_earlier_parts(units, drafts, parent, rest);
    add_copies(left, drafts, earlier, parent);
    std::vector<std::uint32_t> clashes;
    clashes.reserve(left.size());
    for (const ClashUnit& unit : left)
        clashes.push_back(unit.clashes.front());
    for (const Cover& cover : cover_by_part(facts_, clashes, is_last ? 1 : options_.least)) {
        Draft& draft = add_draft(drafts, parent, GroupKind::part, facts_.parts[cover.centre].key);
        draft.part = cover.centre;
        for (const std::uint32_t clash : cover.members)
            draft.units.push_back({{clash}, kNoGroupPart});
    }
    for (const std::uint32_t clash : clashes)
        rest.push_back({{clash}, kNoGroupPart});
    std::ranges::sort(rest, {},
                      [&](const ClashUnit& unit) { return facts_.rank[unit.clashes[0]]; });
    std::vector<ClashGroup> groups = finish(drafts, level, false);
    for (ClashGroup& group : divide(std::move(rest), level + 1, parent))
        groups.push_back(std::move(group));
    return groups;
}

/// Assigns units to the earlier places that they belong to or are near. Returns the others.
std::vector<ClashUnit> ClashGrouper::join_earlier_places(std::vector<ClashUnit>& units,
                                                         std::vector<Draft>& drafts,
                                                         const std::string& parent) {
    const std::size_t earlier = drafts.size();
    EarlierPlaces places(options_.reach);
    for (const Draft& draft : drafts)
        places.add(draft.group.centre);
    std::vector<ClashUnit> left;
    SearchSteps steps;
    for (ClashUnit& unit : units) {
        (void)steps.take();
        const EarlierGroup* group = earlier_group(unit, parent);
        Draft* best = group != nullptr && group->kind == GroupKind::place
                          ? find_draft(drafts, earlier, group->id)
                          : nullptr;
        if (best == nullptr)
            if (const auto near = places.nearest(point_of(unit)))
                best = &drafts[*near];
        (best != nullptr ? best->units : left).push_back(std::move(unit));
    }
    return left;
}

std::vector<ClashGroup> ClashGrouper::by_place(std::vector<ClashUnit>& units, std::size_t level,
                                               const std::string& parent) {
    std::vector<Draft> drafts = earlier_drafts(parent, true);
    std::vector<ClashUnit> left = join_earlier_places(units, drafts, parent);
    std::unordered_map<std::uint32_t, ClashUnit*> unit_of;
    std::vector<std::uint32_t> clashes;
    for (ClashUnit& unit : left) {
        clashes.push_back(unit.clashes.front());
        unit_of.emplace(unit.clashes.front(), &unit);
    }
    for (const Cover& cover : cover_by_place(facts_, clashes, options_.reach)) {
        Draft& draft = add_draft(drafts, parent, GroupKind::place,
                                 clash_id_text(facts_.report.clashes[cover.centre].id));
        draft.group.centre = facts_.clashes[cover.centre].point;
        for (const std::uint32_t clash : cover.members)
            draft.units.push_back(std::move(*unit_of.at(clash)));
    }
    return finish(drafts, level, true);
}

void require_options(const GroupOptions& options) {
    (void)parse_grouping(to_string(options.by));
    if (!(options.reach > 0) || std::isinf(options.reach))
        throw Error(ErrorCode::bad_argument, "the reach of a place must be a positive length");
}

} // namespace

std::vector<ClashGroup> group_clashes(const ClashReport& report, const std::vector<Scene>& models,
                                      const GroupOptions& options) {
    require_options(options);
    const StopScope stopping(options.progress);
    const GroupFacts facts = gather_facts(report, models);
    return ClashGrouper(facts, options).run();
}

} // namespace abut
