#pragma once

#include <abut/clash.h>
#include <abut/clash_review.h>

#include "clash/report/json_lines.h"

#include <vector>

/// The members of JSON reports that several writers share.
namespace abut {

/// Appends all members of a report to the open object.
void write_report(JsonLines& out, const ClashReport& report, const std::vector<Scene>& models);

/// Appends the members before the clashes: "models" to "counts", and "statuses" if there are any.
void write_head(JsonLines& out, const ClashReport& report);
/// Appends "resolved" if the report has statuses.
void write_resolved(JsonLines& out, const ClashReport& report);
/// Appends the object of one question of a store.
void write_review(JsonLines& out, const ClashReview& review);

/// Appends "seconds" and "peak_rss_mib".
void write_tail(JsonLines& out, const ClashReport& report);

} // namespace abut
