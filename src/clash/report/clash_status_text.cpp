#include "clash/report/clash_status_text.h"

#include <abut/clash_review.h>

#include <ctime>
#include <fmt/chrono.h>

namespace abut {

const char* to_string(ClashStatus status) {
    switch (status) {
    case ClashStatus::fresh:
        return "new";
    case ClashStatus::active:
        return "active";
    case ClashStatus::reviewed:
        return "reviewed";
    case ClashStatus::approved:
        return "approved";
    case ClashStatus::resolved:
        return "resolved";
    }
    return "unknown";
}

std::string time_text(std::int64_t seconds) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

void append_json_statuses(TextBuffer& out, const std::array<std::uint64_t, 5>& statuses) {
    const char* separator = "{";
    for (const ClashStatus status : kClashStatuses) {
        fmt::format_to(fmt::appender(out), "{}\"{}\": {}", separator, to_string(status),
                       statuses[static_cast<std::size_t>(status)]);
        separator = ", ";
    }
    out.push_back('}');
}

void append_json_listed(TextBuffer& out, const ListedClash& clash) {
    fmt::format_to(fmt::appender(out), "{{\"id\": \"{}\", \"kind\": \"{}\", \"status\": \"{}\"",
                   clash_id_text(clash.id), to_string(clash.kind), to_string(clash.status));
    const auto text = [&](std::string_view key, std::string_view value) {
        fmt::format_to(fmt::appender(out), ", \"{}\": ", key);
        append_json_string(out, value);
    };
    const auto texts = [&](std::string_view suffix, const std::array<std::string, 2>& values) {
        text(fmt::format("a{}", suffix), values[0]);
        text(fmt::format("b{}", suffix), values[1]);
    };
    texts("", clash.part);
    texts("_name", clash.name);
    texts("_type", clash.type);
    texts("_file", clash.file);
    append(out, ", \"distance\": ");
    append_json_number(out, clash.distance);
    if (clash.resolved != 0)
        text("resolved", time_text(clash.resolved));
    if (!clash.note.empty())
        text("note", clash.note);
    out.push_back('}');
}

namespace {

/// Appends a JSON array with one clash per line.
void append_json_list(TextBuffer& out, const std::vector<ListedClash>& clashes) {
    const char* separator = "[\n  ";
    for (const ListedClash& clash : clashes) {
        append(out, separator);
        append_json_listed(out, clash);
        separator = ",\n  ";
    }
    append(out, clashes.empty() ? "[\n]" : "\n]");
}

} // namespace

void append_json_resolved(TextBuffer& out, const ClashReport& report) {
    if (!report.statuses)
        return;
    append(out, "\"resolved\": ");
    append_json_list(out, report.resolved);
    append(out, ",\n");
}

std::string to_json(const ClashReview& review) {
    TextBuffer out;
    append(out, "{\"clearance\": ");
    append_json_number(out, review.clearance);
    append(out, ", \"touch\": ");
    append_json_number(out, review.touch_tolerance);
    fmt::format_to(fmt::appender(out), ", \"self\": {}, \"rules\": {}, \"finished\": ", review.self,
                   review.rules);
    append_json_string(out, review.finished == 0 ? "" : time_text(review.finished));
    append(out, ", \"statuses\": ");
    append_json_statuses(out, review.statuses);
    append(out, ", \"clashes\": ");
    append_json_list(out, review.clashes);
    out.push_back('}');
    return fmt::to_string(out);
}

} // namespace abut
