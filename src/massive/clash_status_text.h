#pragma once

#include <abut/clash.h>

#include "massive/clash_text.h"

#include <array>
#include <cstdint>
#include <string>

/// What reports say of statuses.
namespace abut {

/// "2026-11-22T10:00:00Z", of seconds since 1970.
std::string time_text(std::int64_t seconds);

/// Appends {"new": 1, ...}.
void append_json_statuses(TextBuffer& out, const std::array<std::uint64_t, 5>& statuses);
/// Appends an object.
void append_json_listed(TextBuffer& out, const ListedClash& clash);
/// Appends `"resolved": [...],`, one clash a line; nothing where the report has no statuses.
void append_json_resolved(TextBuffer& out, const ClashReport& report);

} // namespace abut
