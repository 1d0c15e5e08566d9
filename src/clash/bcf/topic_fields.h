#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace abut {

/// "2026-03-01T08:00:00Z".
std::string bcf_time(std::int64_t seconds);
/// Seconds since 1970 of a time with or without a time zone; none if the text is no time.
std::optional<std::int64_t> parse_bcf_time(std::string_view text);

/// Words that an export adds to a topic, so that an import can tell them from those of people: labels with one of these
/// beginnings, and the line of the description with that one.
inline constexpr std::array<std::string_view, 3> kDerivedLabels{
    "kind: ", "storey: ", "discipline: "};
inline constexpr std::string_view kDerivedLine = "Found by Abut: ";

/// Returns a description without the line that the export has added.
std::string without_derived_line(const std::string& description);
bool is_derived_label(std::string_view label);

} // namespace abut
