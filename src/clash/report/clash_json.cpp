#include "clash/report/clash_json.h"

#include <abut/clash_review.h>

#include "clash/report/clash_text.h"
#include "clash/report/group_json.h"
#include "core/atomic_file.h"

#include <array>

namespace abut {

using nlohmann::ordered_json;

namespace {

ordered_json json_of(const Clash& clash, const std::vector<Scene>& models) {
    constexpr std::size_t kMostMembers = 23;
    const Part& a = part_of(clash, 0, models);
    const Part& b = part_of(clash, 1, models);
    ordered_json row = ordered_json::object();
    row.get_ref<ordered_json::object_t&>().reserve(kMostMembers);
    put(row, "id", clash_id_text(clash.id));
    put(row, "kind", to_string(clash.kind));
    put(row, "a", a.id);
    put(row, "b", b.id);
    put(row, "a_name", a.name);
    put(row, "b_name", b.name);
    put(row, "a_type", a.type);
    put(row, "b_type", b.type);
    put(row, "a_file", models[clash.model[0]].file);
    put(row, "b_file", models[clash.model[1]].file);
    put(row, "distance", json_number(told_distance(clash)));
    put(row, "point_a", json_point(clash.point_a));
    put(row, "point_b", json_point(clash.point_b));
    put(row, "direction", json_point(clash.direction));
    put(row, "triangle_pairs", clash.triangle_pairs);
    if (!clash.rule.empty())
        put(row, "rule", clash.rule);
    if (!clash.severity.empty())
        put(row, "severity", clash.severity);
    if (clash.volume > 0 || clash.volume_error > 0) {
        put(row, "volume", json_number(clash.volume));
        put(row, "volume_error", json_number(clash.volume_error));
    }
    if (clash.neighbours)
        put(row, "neighbours", to_string(*clash.neighbours));
    if (clash.status)
        put(row, "status", to_string(*clash.status));
    if (!clash.note.empty())
        put(row, "note", clash.note);
    return row;
}

ordered_json json_of(const ListedClash& clash) {
    ordered_json row{{"id", clash_id_text(clash.id)},
                     {"kind", to_string(clash.kind)},
                     {"status", to_string(clash.status)},
                     {"a", clash.part[0]},
                     {"b", clash.part[1]},
                     {"a_name", clash.name[0]},
                     {"b_name", clash.name[1]},
                     {"a_type", clash.type[0]},
                     {"b_type", clash.type[1]},
                     {"a_file", clash.file[0]},
                     {"b_file", clash.file[1]},
                     {"distance", json_number(clash.distance)}};
    if (clash.resolved != 0)
        put(row, "resolved", time_text(clash.resolved));
    if (!clash.note.empty())
        put(row, "note", clash.note);
    return row;
}

ordered_json json_of(const SceneNote& note) {
    return {{"kind", to_string(note.kind)},
            {"id", note.id},
            {"name", note.name},
            {"type", note.type},
            {"text", note.text}};
}

ordered_json json_of(const ClashReport::ModelSummary& model) {
    ordered_json row{{"file", model.file},
                     {"parts", model.parts},
                     {"triangles", model.triangles},
                     {"unit", json_number(model.unit)},
                     {"up", to_string(model.up)},
                     {"precision", json_number(model.precision)},
                     {"rounding", json_number(model.rounding)}};
    if (model.notes.empty())
        return row;
    ordered_json notes = ordered_json::array();
    for (const SceneNote& note : model.notes)
        notes.push_back(json_of(note));
    put(row, "notes", std::move(notes));
    return row;
}

ordered_json json_of(const ClashReport::Surfaces& surfaces,
                     const std::vector<ClashReport::ModelSummary>& models) {
    ordered_json parts = ordered_json::array();
    for (const ClashReport::Surfaces::Named& part : surfaces.first)
        parts.push_back({{"file", models[part.model].file},
                         {"id", part.id},
                         {"name", part.name},
                         {"type", part.type}});
    return {{"count", surfaces.count}, {"parts", std::move(parts)}};
}

ordered_json json_of(const ClashReport::Matrix& matrix) {
    ordered_json cells = ordered_json::array();
    for (const ClashReport::Matrix::Cell& cell : matrix.cells) {
        ordered_json row{{"a", matrix.groups[cell.a]},
                         {"b", matrix.groups[cell.b]},
                         {"on", cell.examined},
                         {"clearance", json_number(cell.clearance)}};
        if (!cell.severity.empty())
            put(row, "severity", cell.severity);
        put(row, "counts", json_counts(cell.counts, kClashKinds));
        cells.push_back(std::move(row));
    }
    return {{"groups", matrix.groups}, {"cells", std::move(cells)}};
}

/// Appends an array, each element on a line of its own.
template <typename Element, typename... Others>
void write_array(JsonLines& out, std::string_view name, const std::vector<Element>& elements,
                 const Others&... others) {
    out.key(name);
    out.begin_array();
    for (const Element& element : elements)
        out.value(json_of(element, others...));
    out.end_array();
}

void write_clashes(JsonLines& out, const ClashReport& report, const std::vector<Scene>& models) {
    const std::vector<const ClashGroup*> groups = groups_of_clashes(report);
    out.key("clashes");
    out.begin_array();
    for (std::size_t i = 0; i < report.clashes.size(); ++i) {
        ordered_json row = json_of(report.clashes[i], models);
        if (groups[i] != nullptr)
            put(row, "group", groups[i]->id);
        out.value(row);
    }
    out.end_array();
}

} // namespace

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
    case ClashKind::undecided:
        return "undecided";
    }
    return "unknown";
}

const char* to_string(Neighbours neighbours) {
    switch (neighbours) {
    case Neighbours::fills:
        return "fills";
    case Neighbours::connected:
        return "connected";
    case Neighbours::covers:
        return "covers";
    case Neighbours::same_assembly:
        return "same_assembly";
    }
    return "unknown";
}

const char* to_string(LeftOut reason) {
    constexpr std::array kNames{"not_selected",  "ignored",   "off",
                                "fills",         "connected", "covers",
                                "same_assembly", "tolerated", "other_kind"};
    static_assert(kNames.size() == kLeftOut.size());
    const auto index = static_cast<std::size_t>(reason);
    return index < kNames.size() ? kNames.at(index) : "unknown";
}

const char* to_string(TouchSource source) {
    constexpr std::array kNames{"option", "precision", "rounding", "none"};
    const auto index = static_cast<std::size_t>(source);
    return index < kNames.size() ? kNames.at(index) : "unknown";
}

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

void write_review(JsonLines& out, const ClashReview& review) {
    out.begin_object();
    out.members({{"clearance", json_number(review.clearance)},
                 {"touch", json_length(review.touch_tolerance)},
                 {"self", review.self},
                 {"rules", review.rules},
                 {"finished", review.finished == 0 ? "" : time_text(review.finished)},
                 {"statuses", json_counts(review.statuses, kClashStatuses)}});
    write_array(out, "clashes", review.clashes);
    out.end_object();
}

void write_head(JsonLines& out, const ClashReport& report) {
    write_array(out, "models", report.models);
    out.members(
        {{"frame", {{"up", to_string(report.frame.up)}, {"unit", "m"}, {"of", report.frame.of}}},
         {"warnings", report.warnings},
         {"clearance", json_number(report.clearance)},
         {"touch", json_number(report.touch_tolerance)},
         {"touch_least", json_number(report.least_touch_tolerance)},
         {"touch_source", to_string(report.touch_source)},
         {"touch_file", report.touch_file},
         {"candidates", report.candidates},
         {"counts", json_counts(report.counts, kClashKinds)},
         {"neighbours", json_counts(report.neighbours, kNeighbours)},
         {"left_out", json_counts(report.left_out, kLeftOut)}});
    out.member("surfaces", json_of(report.surfaces, report.models));
    if (report.matrix)
        out.member("matrix", json_of(*report.matrix));
    if (report.statuses)
        out.member("statuses", json_counts(*report.statuses, kClashStatuses));
}

void write_resolved(JsonLines& out, const ClashReport& report) {
    if (report.statuses)
        write_array(out, "resolved", report.resolved);
}

void write_tail(JsonLines& out, const ClashReport& report) {
    const ClashReport::Seconds& seconds = report.seconds;
    out.members({{"seconds",
                  {{"import", json_number(seconds.import)},
                   {"build", json_number(seconds.build)},
                   {"broad", json_number(seconds.broad)},
                   {"narrow", json_number(seconds.narrow)},
                   {"total", json_number(seconds.total)}}},
                 {"peak_rss_mib", json_number(report.peak_rss_mib)}});
}

void write_report(JsonLines& out, const ClashReport& report, const std::vector<Scene>& models) {
    write_head(out, report);
    write_clashes(out, report, models);
    write_resolved(out, report);
    write_groups(out, report, models);
    write_tail(out, report);
}

std::string to_json(const ClashReport& report, const std::vector<Scene>& models) {
    JsonLines out;
    out.begin_object();
    write_report(out, report, models);
    out.end_object();
    return out.take() + "\n";
}

void write_clash_json(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path) {
    write_file_atomically(path, to_json(report, models));
}

std::string to_json(const ClashReview& review) {
    JsonLines out;
    write_review(out, review);
    return out.take();
}

std::string to_json(const std::vector<ClashReview>& reviews, const std::string& store) {
    JsonLines out;
    out.begin_object();
    out.member("store", store);
    out.key("questions");
    out.begin_array();
    for (const ClashReview& review : reviews)
        write_review(out, review);
    out.end_array();
    out.end_object();
    return out.take() + "\n";
}

} // namespace abut
