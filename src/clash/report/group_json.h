#pragma once

#include <abut/clash.h>
#include <abut/topics.h>

#include "clash/report/json_lines.h"

#include <string>
#include <vector>

/// Groups, topics and the history of jobs as JSON (docs/clash-groups.md, docs/topics.md).
namespace abut {

/// Appends "grouping" and "groups" if the report is grouped, and for a store "history", "topics"
/// and "revision".
void write_groups(JsonLines& out, const ClashReport& report, const std::vector<Scene>& models);

nlohmann::ordered_json json_of(const Topic& topic);
nlohmann::ordered_json json_of(const JobCounts& counts);

/// Formats seconds since 1970 as "2026-11-22T10:00:00Z".
std::string time_text(std::int64_t seconds);
/// Parses such a text, with any fraction of a second and any offset ("+01:00").
std::optional<std::int64_t> parse_time(std::string_view text);

/// Returns {name: number} for each key, in the order of `keys`.
template <typename Key, std::size_t count>
nlohmann::ordered_json json_counts(const std::array<std::uint64_t, count>& numbers,
                                   const std::array<Key, count>& keys) {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const Key key : keys)
        put(result, to_string(key), numbers[static_cast<std::size_t>(key)]);
    return result;
}

} // namespace abut
