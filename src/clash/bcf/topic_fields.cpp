#include "clash/bcf/topic_fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>

namespace abut {

namespace {

constexpr std::array<std::string_view, 5> kKnownStatuses{"open", "assigned", "resolved", "closed",
                                                         "approved"};

char lower_letter(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Reads a number of exactly that many digits and moves past it; -1 if there is none.
int take_digits(std::string_view& text, std::size_t count) {
    int value = 0;
    if (text.size() < count)
        return -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + count, value);
    if (error != std::errc() || end != text.data() + count || value < 0)
        return -1;
    text.remove_prefix(count);
    return value;
}

bool take_sign(std::string_view& text, char sign) {
    if (!text.starts_with(sign))
        return false;
    text.remove_prefix(1);
    return true;
}

/// Seconds east of Greenwich; none if the text is no time zone.
std::optional<int> parse_zone(std::string_view text) {
    if (text.empty() || text == "Z")
        return 0;
    const int sign = text.front() == '-' ? -1 : 1;
    if (text.front() != '-' && text.front() != '+')
        return std::nullopt;
    text.remove_prefix(1);
    const int hours = take_digits(text, 2);
    if (hours < 0 || hours > 14 || !take_sign(text, ':'))
        return std::nullopt;
    const int minutes = take_digits(text, 2);
    if (minutes < 0 || minutes > 59 || !text.empty())
        return std::nullopt;
    return sign * (3600 * hours + 60 * minutes);
}

} // namespace

std::string bcf_time(std::int64_t seconds) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

std::optional<std::int64_t> parse_bcf_time(std::string_view text) {
    const int year = take_digits(text, 4);
    if (year < 1 || !take_sign(text, '-'))
        return std::nullopt;
    const int month = take_digits(text, 2);
    if (month < 1 || !take_sign(text, '-'))
        return std::nullopt;
    const int day = take_digits(text, 2);
    const std::chrono::year_month_day date{
        std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
        std::chrono::day(static_cast<unsigned>(std::max(day, 0)))};
    if (!date.ok())
        return std::nullopt;
    const std::int64_t start =
        std::int64_t{86400} * std::chrono::sys_days(date).time_since_epoch().count();
    if (!take_sign(text, 'T'))
        return parse_zone(text) ? std::optional(start - *parse_zone(text)) : std::nullopt;
    const int hour = take_digits(text, 2);
    if (hour < 0 || hour > 24 || !take_sign(text, ':'))
        return std::nullopt;
    const int minute = take_digits(text, 2);
    if (minute < 0 || minute > 59 || !take_sign(text, ':'))
        return std::nullopt;
    const int second = take_digits(text, 2);
    if (second < 0 || second > 60)
        return std::nullopt;
    if (take_sign(text, '.'))
        text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
    const std::optional<int> zone = parse_zone(text);
    if (!zone)
        return std::nullopt;
    const int of_day = 3600 * hour + 60 * minute + second - *zone;
    return start + of_day;
}

std::string topic_status(const std::string& status) {
    std::string lower = status;
    for (char& c : lower)
        c = lower_letter(c);
    for (const std::string_view known : kKnownStatuses)
        if (lower == known)
            return lower;
    return status;
}

std::string bcf_status(const std::string& status) {
    for (const std::string_view known : kKnownStatuses)
        if (status == known) {
            std::string capital = status;
            capital.front() = static_cast<char>(capital.front() - 'a' + 'A');
            return capital;
        }
    return status;
}

std::string derived_priority(const std::string& description) {
    const std::size_t line = description.find(kDerivedLine);
    const std::size_t at = description.find(kDerivedPriority, std::min(line, description.size()));
    if (line == std::string::npos || at == std::string::npos || description.find('\n', line) < at)
        return "";
    const std::size_t first = at + kDerivedPriority.size();
    return description.substr(first, description.find('\n', first) - first);
}

std::string without_derived_line(const std::string& description) {
    std::string rest = description;
    const std::size_t at =
        rest.starts_with(kDerivedLine) ? 0 : rest.find("\n" + std::string(kDerivedLine));
    if (at == std::string::npos)
        return rest;
    const std::size_t end = std::min(rest.find('\n', at + 1), rest.size());
    rest.erase(at, end - at);
    if (at == 0 && rest.starts_with('\n'))
        rest.erase(0, 1);
    return rest;
}

bool is_derived_label(std::string_view label) {
    return std::ranges::any_of(
        kDerivedLabels, [&](std::string_view beginning) { return label.starts_with(beginning); });
}

BcfTopic bcf_topic(const Topic& topic, const std::string& author, std::int64_t time) {
    const bool is_new = topic.created == 0;
    BcfTopic result;
    result.guid = result.folder = topic.guid;
    result.title = topic.title;
    if (!is_new)
        result.description = topic.description;
    result.type = topic.type;
    result.status = bcf_status(topic.status);
    result.priority = topic.priority;
    result.stage = topic.stage;
    result.assigned_to = topic.assignee;
    result.labels = topic.labels;
    result.reference_links = topic.reference_links;
    if (!topic.due.empty())
        result.due_date = topic.due + "T00:00:00Z";
    result.creation_author = topic.created_by.empty() ? author : topic.created_by;
    result.creation_date = bcf_time(is_new ? time : topic.created);
    if (!is_new) {
        result.modified_date = bcf_time(std::max(topic.modified, topic.created));
        result.modified_author = topic.modified_by;
    }
    for (const TopicComment& comment : topic.comments)
        result.comments.push_back({comment.guid,
                                   bcf_time(comment.time),
                                   comment.author,
                                   comment.text,
                                   comment.viewpoint,
                                   {},
                                   {},
                                   {}});
    return result;
}

} // namespace abut
