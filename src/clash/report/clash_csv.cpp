#include <abut/clash.h>

#include "clash/report/clash_text.h"
#include "core/atomic_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

/// Writes CSV as RFC 4180 defines it: a header, CRLF, quotes where a cell needs them; UTF-8 without
/// a byte-order mark.
///
/// A spreadsheet takes a cell that begins with = + - @ | for a formula or a command, even if the
/// cell is quoted, in full width (East Asian forms) or after white space. The texts come from
/// untrusted model files. Such a text therefore gets a leading apostrophe, which marks it as text
/// for a spreadsheet. Numbers are written by this library and stay as they are. Programs that need
/// the unaltered texts read the JSON report.
namespace abut {

namespace {

/// Text under construction; fmt::format_to appends to it.
using TextBuffer = fmt::memory_buffer;

inline void append(TextBuffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

constexpr std::string_view kHeader =
    "id,kind,a,b,a_name,b_name,a_type,b_type,a_file,b_file,distance,"
    "point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,point_b_z,"
    "direction_x,direction_y,direction_z,triangle_pairs,rule,severity,volume,volume_error,"
    "neighbours";
constexpr std::string_view kStatusHeader = ",status,note"; // only in reports of a store
constexpr std::string_view kGroupHeader = ",group,group_name";

/// Returns whether a spreadsheet may take the text for a formula or a command. A leading control
/// character suffices, because programs differ in which of them they skip.
bool is_active(std::string_view text) {
    using namespace std::string_view_literals;
    // The second row holds the same characters in full width.
    constexpr std::array kStarts{"="sv,      "+"sv,      "-"sv,      "@"sv,      "|"sv,
                                 "\uFF1D"sv, "\uFF0B"sv, "\uFF0D"sv, "\uFF20"sv, "\uFF5C"sv};
    // Space, no-break, ideographic and zero-width space, byte-order mark.
    constexpr std::array kSpaces{" "sv, "\u00A0"sv, "\u3000"sv, "\u200B"sv, "\uFEFF"sv};
    const auto leads = [&](std::string_view start) { return text.starts_with(start); };
    for (auto space = kSpaces.begin();
         (space = std::ranges::find_if(kSpaces, leads)) != kSpaces.end();)
        text.remove_prefix(space->size());
    const bool control = !text.empty() && static_cast<unsigned char>(text.front()) < 0x20;
    return control || std::ranges::any_of(kStarts, leads);
}

/// Appends a comma and the text.
void append_cell(TextBuffer& out, std::string_view raw) {
    const std::string text = valid_utf8(raw);
    const bool formula = is_active(text);
    const bool quoted = text.find_first_of("\",\r\n") != std::string::npos;
    append(out, quoted ? ",\"" : ",");
    if (formula)
        out.push_back('\'');
    for (const char c : text) {
        if (c == '"')
            out.push_back('"');
        out.push_back(c);
    }
    if (quoted)
        out.push_back('"');
}

/// Appends a comma and the number; a number that is not finite leaves its cell empty.
void append_cell(TextBuffer& out, double value) {
    out.push_back(',');
    if (std::isfinite(value))
        fmt::format_to(fmt::appender(out), "{}", value);
}

void append_cells(TextBuffer& out, const Vec3& point) {
    append_cell(out, point.x);
    append_cell(out, point.y);
    append_cell(out, point.z);
}

void append_row(TextBuffer& out, const Clash& clash, const std::vector<Scene>& models,
                bool with_status, bool with_group, const ClashGroup* group) {
    const Part& a = part_of(clash, 0, models);
    const Part& b = part_of(clash, 1, models);
    fmt::format_to(fmt::appender(out), "{:016x},{}", clash.id, to_string(clash.kind));
    append_cell(out, a.id);
    append_cell(out, b.id);
    append_cell(out, a.name);
    append_cell(out, b.name);
    append_cell(out, a.type);
    append_cell(out, b.type);
    append_cell(out, models[clash.model[0]].file);
    append_cell(out, models[clash.model[1]].file);
    append_cell(out, clash.distance);
    append_cells(out, clash.point_a);
    append_cells(out, clash.point_b);
    append_cells(out, clash.direction);
    fmt::format_to(fmt::appender(out), ",{}", clash.triangle_pairs);
    append_cell(out, clash.rule);
    append_cell(out, clash.severity);
    append_cell(out, clash.volume);
    append_cell(out, clash.volume_error);
    append_cell(out, clash.neighbours ? to_string(*clash.neighbours) : "");
    if (with_status) {
        append_cell(out, clash.status ? to_string(*clash.status) : "");
        append_cell(out, clash.note);
    }
    if (with_group) {
        append_cell(out, group != nullptr ? group->id : "");
        append_cell(out, group != nullptr ? group->name : "");
    }
    append(out, "\r\n");
}

} // namespace

void write_clash_csv(const ClashReport& report, const std::vector<Scene>& models,
                     const std::string& path) {
    TextBuffer out;
    append(out, kHeader);
    append(out, report.statuses ? kStatusHeader : "");
    append(out, report.grouping.empty() ? "" : kGroupHeader);
    append(out, "\r\n");
    const std::vector<const ClashGroup*> groups = groups_of_clashes(report);
    for (std::size_t i = 0; i < report.clashes.size(); ++i)
        append_row(out, report.clashes[i], models, report.statuses.has_value(),
                   !report.grouping.empty(), groups[i]);
    write_file_atomically(path, {out.data(), out.size()});
}

} // namespace abut
