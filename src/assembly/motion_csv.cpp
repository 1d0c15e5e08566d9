#include <abut/assembly.h>

#include "assembly/part_names.h"
#include "clash/report/csv_cells.h"
#include "core/atomic_file.h"

namespace abut {

namespace {

constexpr std::string_view kMotionHeader =
    "kind,a,b,start,end,seen,gap,gap_at_least,gap_time,depth,depth_at_most,depth_time,"
    "point_x,point_y,point_z,status\r\n";

void append_interval(TextBuffer& out, const MotionClash& clash, const MotionInterval& interval,
                     MotionClashKind kind, const Assembly& assembly) {
    append(out, to_string(kind));
    append_cell(out, part_name(assembly, clash.a));
    append_cell(out, part_name(assembly, clash.b));
    for (const double value : {interval.start, interval.end, interval.seen, clash.gap,
                               clash.gap_at_least, clash.gap_time, clash.depth, clash.depth_at_most,
                               clash.depth_time, clash.point_b.x, clash.point_b.y, clash.point_b.z})
        append_cell(out, value);
    append_cell(out, clash.status == Status::exact ? "exact" : "bound_only");
    append(out, "\r\n");
}

} // namespace

void write_motion_csv(const MotionReport& report, const Assembly& assembly,
                      const std::string& path) {
    TextBuffer out;
    append(out, kMotionHeader);
    for (const MotionClash& clash : report.clashes) {
        for (const MotionInterval& contact : clash.contacts)
            append_interval(out, clash, contact, MotionClashKind::contact, assembly);
        for (const MotionInterval& near : clash.approaches)
            append_interval(out, clash, near, MotionClashKind::clearance, assembly);
    }
    write_file_atomically(path, {out.data(), out.size()});
}

} // namespace abut
