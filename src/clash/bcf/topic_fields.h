#pragma once

#include <abut/bcf.h>
#include <abut/topics.h>

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

/// The known statuses begin with a capital letter in BCF: "open" and "Open".
std::string bcf_status(const std::string& status);
std::string topic_status(const std::string& status);

/// Words that an export adds to a topic and an import takes away again: labels with one of these
/// beginnings, and the line of the description with that one.
inline constexpr std::array<std::string_view, 3> kDerivedLabels{
    "kind: ", "storey: ", "discipline: "};
inline constexpr std::string_view kDerivedLine = "Found by Abut: ";
/// Precedes the severity, which ends the line, where the severity is the topic's priority.
inline constexpr std::string_view kDerivedPriority = "; severity: ";

/// Returns a description without the line that the export has added.
std::string without_derived_line(const std::string& description);
bool is_derived_label(std::string_view label);
/// Returns the priority that the export has added to a topic without one; empty if none.
std::string derived_priority(const std::string& description);

/// The entry of a file that says which revision of a store's topics it was exported from.
inline constexpr const char *kRevisionEntry = "abut.txt", *kRevisionWord = "revision ";

/// Returns a topic without its files and viewpoints. One that no store has yet has neither a
/// description nor a date of change.
///
/// In          time: of a topic that has none.
BcfTopic bcf_topic(const Topic& topic, const std::string& author, std::int64_t time);

} // namespace abut
