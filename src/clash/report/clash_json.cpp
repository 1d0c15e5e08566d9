#include <abut/clash.h>

#include "clash/report/clash_status_text.h"
#include "clash/report/clash_text.h"
#include "core/atomic_file.h"

namespace abut {

const char* to_string(ClashKind kind) {
    switch (kind) {
    case ClashKind::hard:
        return "hard";
    case ClashKind::touch:
        return "touch";
    case ClashKind::contained:
        return "contained";
    case ClashKind::duplicate:
        return "duplicate";
    case ClashKind::clearance:
        return "clearance";
    }
    return "unknown";
}

namespace {

void append_clash(TextBuffer& out, const Clash& clash, const std::vector<Scene>& models) {
    const Part& a = part_of(clash, 0, models);
    const Part& b = part_of(clash, 1, models);
    fmt::format_to(fmt::appender(out), "{{\"id\": \"{:016x}\", \"kind\": \"{}\"", clash.id,
                   to_string(clash.kind));
    const auto text = [&](std::string_view key, std::string_view value) {
        fmt::format_to(fmt::appender(out), ", \"{}\": ", key);
        append_json_string(out, value);
    };
    text("a", a.id);
    text("b", b.id);
    text("a_name", a.name);
    text("b_name", b.name);
    text("a_type", a.type);
    text("b_type", b.type);
    text("a_file", models[clash.model[0]].file);
    text("b_file", models[clash.model[1]].file);
    append(out, ", \"distance\": ");
    append_json_number(out, clash.distance);
    append(out, ", \"point_a\": ");
    append_json_point(out, clash.point_a);
    append(out, ", \"point_b\": ");
    append_json_point(out, clash.point_b);
    append(out, ", \"direction\": ");
    append_json_point(out, clash.direction);
    fmt::format_to(fmt::appender(out), ", \"triangle_pairs\": {}", clash.triangle_pairs);
    if (!clash.rule.empty())
        text("rule", clash.rule);
    if (clash.status)
        text("status", to_string(*clash.status));
    if (!clash.note.empty())
        text("note", clash.note);
    out.push_back('}');
}

} // namespace

// Writes one clash per line, so that line tools can search, compare and cut a report.
std::string to_json(const ClashReport& report, const std::vector<Scene>& models) {
    TextBuffer out;
    append(out, "{\n");
    append_json_head(out, report);
    append(out, "\"clashes\": [");
    const char* separator = "\n  ";
    for (const Clash& clash : report.clashes) {
        append(out, separator);
        append_clash(out, clash, models);
        separator = ",\n  ";
    }
    append(out, "\n],\n");
    append_json_resolved(out, report);
    append_json_tail(out, report);
    append(out, "}\n");
    return fmt::to_string(out);
}

void write_clash_json(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path) {
    write_file_atomically(path, to_json(report, models));
}

} // namespace abut
