#include "clash/report/group_json.h"

#include <abut/clash_review.h>

#include "clash/report/clash_json.h"
#include "clash/report/clash_text.h"

#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>

namespace abut {

using nlohmann::ordered_json;

namespace {

ordered_json json_of(const ClashGroup& group, const ClashReport& report,
                     const std::vector<Scene>& models) {
    ordered_json row{{"id", group.id},
                     {"name", group.name},
                     {"what", group.what},
                     {"kind", to_string(group.kind)},
                     {"key", group.key},
                     {"size", group.clashes.size()},
                     {"counts", json_counts(group.counts, kClashKinds)},
                     {"deepest", json_number(group.deepest)},
                     {"bounds", {json_point(group.bounds.lower), json_point(group.bounds.upper)}},
                     {"centre", json_point(group.centre)}};
    if (group.part) {
        const Scene& model = models.at(group.part->at(0));
        const Part& part = model.parts.at(group.part->at(1));
        put(row, "part",
            {{"id", part.id}, {"name", part.name}, {"type", part.type}, {"file", model.file}});
    }
    if (group.change)
        put(row, "change", to_string(*group.change));
    ordered_json members = ordered_json::array();
    if (group.groups.empty()) {
        for (const std::uint32_t clash : group.clashes)
            members.push_back(clash_id_text(report.clashes.at(clash).id));
        put(row, "clashes", std::move(members));
    } else {
        for (const ClashGroup& inner : group.groups)
            members.push_back(json_of(inner, report, models));
        put(row, "groups", std::move(members));
    }
    return row;
}

/// The times whose years have four digits: from the first, before the second.
constexpr std::int64_t kYear0 = -62'167'219'200, kYear10000 = 253'402'300'800;

/// Removes `count` digits from the beginning of the text; none if there are fewer.
std::optional<int> take_number(std::string_view& text, std::size_t count) {
    int value = 0;
    if (text.size() < count)
        return std::nullopt;
    const auto [end, error] = std::from_chars(text.data(), text.data() + count, value);
    if (error != std::errc() || end != text.data() + count || value < 0)
        return std::nullopt;
    text.remove_prefix(count);
    return value;
}

bool take_char(std::string_view& text, char c) {
    if (text.empty() || text.front() != c)
        return false;
    text.remove_prefix(1);
    return true;
}

/// Seconds of an offset such as "Z", "+01:00" or nothing, which must be the rest of the text.
std::optional<std::int64_t> parse_offset(std::string_view text) {
    if (text.empty() || text == "Z")
        return 0;
    const bool is_west = text.front() == '-';
    if (!take_char(text, '-') && !take_char(text, '+'))
        return std::nullopt;
    const auto hours = take_number(text, 2);
    (void)take_char(text, ':');
    const auto minutes = text.empty() ? std::optional(0) : take_number(text, 2);
    if (!hours || !minutes || !text.empty())
        return std::nullopt;
    const std::int64_t seconds = std::int64_t{*hours} * 3600 + std::int64_t{*minutes} * 60;
    return is_west ? -seconds : seconds;
}

ordered_json json_of(const ListedGroup& group) {
    ordered_json row{{"id", group.id},
                     {"path", group.path},
                     {"name", group.name},
                     {"what", group.what},
                     {"kind", to_string(group.kind)},
                     {"change", to_string(group.change)},
                     {"size", group.size},
                     {"centre", json_point(group.centre)}};
    const std::pair<const char*, std::int64_t> times[]{{"appeared", group.appeared},
                                                       {"reopened", group.reopened},
                                                       {"moved", group.moved},
                                                       {"resolved", group.resolved}};
    for (const auto& [key, time] : times)
        if (time != 0)
            put(row, key, time_text(time));
    if (group.topic)
        put(row, "topic", group.topic->guid);
    return row;
}

template <typename Row>
void write_rows(JsonLines& out, const char* name, const std::vector<Row>& rows) {
    out.key(name);
    out.begin_array();
    for (const Row& row : rows)
        out.value(json_of(row));
    out.end_array();
}

void write_group_review(JsonLines& out, const GroupReview& review) {
    out.begin_object();
    out.members({{"clearance", json_number(review.clearance)},
                 {"touch", json_length(review.touch_tolerance)},
                 {"self", review.self},
                 {"rules", review.rules},
                 {"grouping", to_string(review.by)},
                 {"since", review.since == 0 ? "" : time_text(review.since)},
                 {"finished", review.finished == 0 ? "" : time_text(review.finished)},
                 {"changes", json_counts(review.changes, kGroupChanges)}});
    write_rows(out, "groups", review.groups);
    write_rows(out, "history", review.history);
    out.end_object();
}

} // namespace

std::string to_json(const GroupReview& review) {
    JsonLines out;
    write_group_review(out, review);
    return out.take();
}

std::string to_json(const std::vector<ClashReview>& reviews, const std::vector<GroupReview>& groups,
                    const std::vector<Topic>& topics, std::int64_t revision,
                    const std::string& store) {
    JsonLines out;
    out.begin_object();
    out.member("store", store);
    out.key("questions");
    out.begin_array();
    for (const ClashReview& review : reviews)
        write_review(out, review);
    out.end_array();
    out.key("groupings");
    out.begin_array();
    for (const GroupReview& review : groups)
        write_group_review(out, review);
    out.end_array();
    write_rows(out, "topics", topics);
    out.member("revision", revision);
    out.end_object();
    return out.take() + "\n";
}

std::string time_text(std::int64_t seconds) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

std::optional<std::int64_t> parse_time(std::string_view text) {
    const auto year = take_number(text, 4);
    const bool dash = take_char(text, '-');
    const auto month = take_number(text, 2);
    const bool dash_2 = take_char(text, '-');
    const auto day = take_number(text, 2);
    if (!year || !dash || !month || !dash_2 || !day)
        return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(*year),
                                           std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok())
        return std::nullopt;
    const std::int64_t seconds =
        std::chrono::sys_days(date).time_since_epoch().count() * std::int64_t{86400};
    if (text.empty())
        return seconds;
    if (!take_char(text, 'T') && !take_char(text, ' '))
        return std::nullopt;
    std::array<int, 3> clock{}; // hours, minutes, seconds; the seconds may be missing
    for (std::size_t i = 0; i < clock.size(); ++i) {
        if (i > 0 && !take_char(text, ':')) {
            if (i == 1)
                return std::nullopt;
            break;
        }
        const auto value = take_number(text, 2);
        if (!value)
            return std::nullopt;
        clock.at(i) = *value;
    }
    if (take_char(text, '.'))
        while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0)
            text.remove_prefix(1);
    const auto offset = parse_offset(text);
    if (!offset)
        return std::nullopt;
    const std::int64_t time =
        seconds + std::int64_t{clock[0]} * 3600 + std::int64_t{clock[1]} * 60 + clock[2] - *offset;
    // 24:00 is the end of a day, 23:59:60 a leap second.
    if (clock[0] > 24 || clock[1] > 59 || clock[2] > 60 || time < kYear0 || time >= kYear10000)
        return std::nullopt;
    return time;
}

ordered_json json_of(const Topic& topic) {
    ordered_json comments = ordered_json::array();
    for (const TopicComment& comment : topic.comments) {
        ordered_json row{{"guid", comment.guid},
                         {"author", comment.author},
                         {"time", time_text(comment.time)},
                         {"text", comment.text}};
        if (!comment.viewpoint.empty())
            put(row, "viewpoint", comment.viewpoint);
        comments.push_back(std::move(row));
    }
    ordered_json clashes = ordered_json::array();
    for (const std::uint64_t clash : topic.clashes)
        clashes.push_back(clash_id_text(clash));
    return {{"guid", topic.guid},
            {"group", topic.group},
            {"title", topic.title},
            {"description", topic.description},
            {"status", topic.status},
            {"type", topic.type},
            {"priority", topic.priority},
            {"stage", topic.stage},
            {"assignee", topic.assignee},
            {"due", topic.due},
            {"labels", topic.labels},
            {"reference_links", topic.reference_links},
            {"clashes", std::move(clashes)},
            {"created", topic.created == 0 ? "" : time_text(topic.created)},
            {"created_by", topic.created_by},
            {"modified", topic.modified == 0 ? "" : time_text(topic.modified)},
            {"modified_by", topic.modified_by},
            {"comments", std::move(comments)}};
}

ordered_json json_of(const JobCounts& counts) {
    return {{"finished", time_text(counts.finished)},
            {"kinds", json_counts(counts.kinds, kClashKinds)},
            {"statuses", json_counts(counts.statuses, kClashStatuses)},
            {"groups", json_counts(counts.groups, kGroupChanges)}};
}

void write_groups(JsonLines& out, const ClashReport& report, const std::vector<Scene>& models) {
    if (report.grouping.empty())
        return;
    out.member("grouping", to_string(report.grouping));
    out.key("groups");
    out.begin_array();
    for (const ClashGroup& group : report.groups)
        out.value(json_of(group, report, models));
    out.end_array();
    if (!report.statuses)
        return;
    write_rows(out, "history", report.history);
    write_rows(out, "topics", report.topics);
    out.member("revision", report.topics_revision);
}

} // namespace abut
