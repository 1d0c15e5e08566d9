#include "clash/bcf/topic_fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>

namespace abut {

namespace {

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
    return start + 3600 * hour + 60 * minute + second - *zone;
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

} // namespace abut
