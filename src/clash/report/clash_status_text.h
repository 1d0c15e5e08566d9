#pragma once

#include <abut/clash.h>

#include "clash/report/clash_text.h"

#include <array>
#include <cstdint>
#include <string>

/// Text of clash statuses in reports.
namespace abut {

/// Formats seconds since 1970 as "2026-11-22T10:00:00Z".
std::string time_text(std::int64_t seconds);

/// Appends the number of clashes of each status as {"new": 1, ...}.
void append_json_statuses(TextBuffer& out, const std::array<std::uint64_t, 5>& statuses);
/// Appends a clash as a JSON object.
void append_json_listed(TextBuffer& out, const ListedClash& clash);
/// Appends `"resolved": [...],`, one clash per line; appends nothing if the report has no statuses.
void append_json_resolved(TextBuffer& out, const ClashReport& report);

} // namespace abut
