#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/error.h>

#include <algorithm>

namespace abut {

namespace {

void collect_innermost(const std::vector<ClashGroup>& groups,
                       std::vector<const ClashGroup*>& found) {
    for (const ClashGroup& group : groups)
        if (group.groups.empty())
            found.push_back(&group);
        else
            collect_innermost(group.groups, found);
}

} // namespace

const char* to_string(GroupBy by) {
    switch (by) {
    case GroupBy::part:
        return "part";
    case GroupBy::place:
        return "place";
    case GroupBy::storey:
        return "storey";
    case GroupBy::system:
        return "system";
    case GroupBy::types:
        return "types";
    case GroupBy::discipline:
        return "discipline";
    }
    return "unknown";
}

std::string to_string(const std::vector<GroupBy>& by) {
    std::string text;
    for (const GroupBy one : by)
        text += (text.empty() ? "" : ",") + std::string(to_string(one));
    return text;
}

std::vector<GroupBy> parse_grouping(std::string_view text) {
    std::vector<GroupBy> by;
    while (true) {
        const std::string_view word = text.substr(0, text.find(','));
        const auto* const found = std::ranges::find_if(
            kGroupCriteria, [&](GroupBy one) { return word == to_string(one); });
        if (found == kGroupCriteria.end())
            throw Error(ErrorCode::bad_argument,
                        "'" + std::string(word) +
                            "' is not a criterion of groups: part, place, storey, system, types, "
                            "discipline");
        if (std::ranges::find(by, *found) != by.end())
            throw Error(ErrorCode::bad_argument,
                        "the criterion '" + std::string(word) + "' is given twice");
        by.push_back(*found);
        if (word.size() == text.size())
            return by;
        text.remove_prefix(word.size() + 1);
    }
}

const char* to_string(GroupKind kind) {
    switch (kind) {
    case GroupKind::part:
        return "part";
    case GroupKind::copies:
        return "copies";
    case GroupKind::place:
        return "place";
    case GroupKind::storey:
        return "storey";
    case GroupKind::system:
        return "system";
    case GroupKind::types:
        return "types";
    case GroupKind::discipline:
        return "discipline";
    }
    return "unknown";
}

const char* to_string(GroupChange change) {
    switch (change) {
    case GroupChange::fresh:
        return "new";
    case GroupChange::active:
        return "active";
    case GroupChange::moved:
        return "moved";
    case GroupChange::reopened:
        return "reopened";
    case GroupChange::resolved:
        return "resolved";
    }
    return "unknown";
}

std::vector<const ClashGroup*> innermost_groups(const std::vector<ClashGroup>& groups) {
    std::vector<const ClashGroup*> found;
    collect_innermost(groups, found);
    return found;
}

std::vector<const ClashGroup*> groups_of_clashes(const ClashReport& report) {
    std::vector<const ClashGroup*> result(report.clashes.size());
    for (const ClashGroup* group : innermost_groups(report.groups))
        for (const std::uint32_t clash : group->clashes)
            if (clash < result.size())
                result[clash] = group;
    return result;
}

} // namespace abut
