#include <abut/clash.h>

#include "clash/report/clash_text.h"
#include "clash/report/csv_cells.h"
#include "core/atomic_file.h"

#include <fmt/format.h>
#include <string_view>

namespace abut {

namespace {

constexpr std::string_view kHeader =
    "id,kind,a,b,a_name,b_name,a_type,b_type,a_file,b_file,distance,"
    "point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,point_b_z,"
    "direction_x,direction_y,direction_z,triangle_pairs,rule,severity,volume,volume_error,"
    "neighbours";
constexpr std::string_view kStatusHeader = ",status,note"; // only in reports of a store
constexpr std::string_view kGroupHeader = ",group,group_name";

void append_cells(TextBuffer& out, const Vec3& v, double rounding) {
    append_rounded_cell(out, v.x, rounding);
    append_rounded_cell(out, v.y, rounding);
    append_rounded_cell(out, v.z, rounding);
}

/// Appends the lengths of a clash, without digits that the rounding of its parts has made, or double
/// precision.
void append_lengths(TextBuffer& out, const Clash& clash) {
    const ClashRounding rounding = rounding_of_numbers(clash);
    append_rounded_cell(out, told_distance(clash), rounding.distance);
    append_cells(out, clash.point_a, rounding.points);
    append_cells(out, clash.point_b, rounding.points);
    append_cells(out, clash.direction, rounding.direction);
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
    append_lengths(out, clash);
    fmt::format_to(fmt::appender(out), ",{}", clash.triangle_pairs);
    append_cell(out, clash.rule);
    append_cell(out, clash.severity);
    append_rounded_cell(out, clash.volume, clash.volume_error);
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
