#include "text/group_summary.h"

#include <abut/clash_groups.h>

#include "arguments/common.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace abut::command {

namespace {

constexpr std::size_t kLargest = 10;

/// An innermost group with the names of the groups around it.
struct PathGroup {
    std::string path;
    const ClashGroup* group;
};

void collect_groups(const std::vector<ClashGroup>& groups, const std::string& path,
                    std::vector<PathGroup>& found) {
    for (const ClashGroup& group : groups) {
        const std::string name = path + shown(group.name);
        if (group.groups.empty())
            found.push_back({name, &group});
        else
            collect_groups(group.groups, name + " / ", found);
    }
}

const char* plural(std::size_t count) {
    return count == 1 ? "" : "s";
}

} // namespace

std::string group_summary(const ClashReport& report) {
    if (report.grouping.empty() || report.clashes.empty())
        return {};
    std::vector<PathGroup> rows;
    collect_groups(report.groups, {}, rows);
    std::ranges::stable_sort(rows, [](const PathGroup& a, const PathGroup& b) {
        return a.group->clashes.size() > b.group->clashes.size();
    });
    std::string text =
        fmt::format("\n{} clash{} in {} group{}, by {}\n", grouped(report.clashes.size()),
                    report.clashes.size() == 1 ? "" : "es", grouped(rows.size()),
                    plural(rows.size()), to_string(report.grouping));
    for (std::size_t i = 0; i < std::min(kLargest, rows.size()); ++i)
        text += fmt::format("  {:>7}  {}: {}\n", grouped(rows[i].group->clashes.size()),
                            rows[i].path, shown(rows[i].group->what));
    if (rows.size() > kLargest) {
        std::size_t others = 0;
        for (std::size_t i = kLargest; i < rows.size(); ++i)
            others += rows[i].group->clashes.size();
        text += fmt::format("  {:>7}  in {} smaller group{}\n", grouped(others),
                            grouped(rows.size() - kLargest), plural(rows.size() - kLargest));
    }
    return text;
}

} // namespace abut::command
