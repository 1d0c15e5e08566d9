#include <abut/clash.h>
#include <abut/error.h>

#include "clash/report/clash_json.h"
#include "clash/report/clash_text.h"
#include "clash/report/report_page.h"
#include "core/atomic_file.h"

#include <array>
#include <unordered_map>

namespace abut {

namespace {

/// Distinct values in order of first use. Each has an index.
class Table {
public:
    std::uint32_t index(const std::string& value) {
        const auto [entry, is_new] = index_.try_emplace(value, index_.size());
        if (is_new)
            values_.push_back(&entry->first);
        return entry->second;
    }
    [[nodiscard]] const std::vector<const std::string*>& values() const { return values_; }

private:
    std::unordered_map<std::string, std::uint32_t> index_;
    std::vector<const std::string*> values_; // keys of the map, whose addresses are stable
};

/// The report as the page reads it: in columns, with every part, type, file and rule stored once. A
/// page of 100,000 clashes has a third of the size that the rows of the JSON report would need.
class PageData {
public:
    PageData(const ClashReport& report, const std::vector<Scene>& models)
        : report_(report), models_(models) {
        for (const Clash& clash : report.clashes) {
            part_index_.push_back({index_part(clash, 0), index_part(clash, 1)});
            rule_index_.push_back(rules_.index(clash.rule));
            note_index_.push_back(notes_.index(clash.note));
        }
    }

    [[nodiscard]] std::string json() const {
        JsonLines out;
        out.begin_object();
        write_head(out, report_);
        write_parts(out);
        write_clashes(out);
        if (report_.statuses)
            write_statuses(out);
        write_tail(out, report_);
        out.end_object();
        return out.take();
    }

private:
    std::uint32_t index_part(const Clash& clash, int side) {
        const Part& part = part_of(clash, side, models_);
        const auto [entry, is_new] =
            parts_.try_emplace(&part, static_cast<std::uint32_t>(parts_.size()));
        if (is_new) {
            part_order_.push_back(&part);
            part_type_.push_back(types_.index(part.type));
            part_file_.push_back(
                files_.index(models_[clash.model[static_cast<std::size_t>(side)]].file));
        }
        return entry->second;
    }

    /// Appends an array: of(row) for each row.
    template <typename Row, typename Of>
    static void write_column(JsonLines& out, std::string_view name, const std::vector<Row>& rows,
                             const Of& of) {
        nlohmann::ordered_json::array_t column;
        column.reserve(rows.size());
        for (const Row& row : rows)
            column.push_back(of(row));
        out.member(name, std::move(column));
    }

    static void write_texts(JsonLines& out, std::string_view name, const Table& table) {
        write_column(out, name, table.values(), [](const std::string* text) { return *text; });
    }

    void write_parts(JsonLines& out) const {
        write_texts(out, "types", types_);
        write_texts(out, "files", files_);
        write_texts(out, "rules", rules_);
        write_column(out, "part_id", part_order_, [](const Part* part) { return part->id; });
        write_column(out, "part_name", part_order_, [](const Part* part) { return part->name; });
        out.member("part_type", part_type_);
        out.member("part_file", part_file_);
    }

    void write_clashes(JsonLines& out) const {
        const auto column = [&](std::string_view name, const auto& of) {
            write_column(out, name, report_.clashes, of);
        };
        const auto side = [&](std::string_view name, std::size_t k) {
            write_column(out, name, part_index_, [&](const auto& parts) { return parts[k]; });
        };
        column("id", [](const Clash& clash) { return clash_id_text(clash.id); });
        column("kind", [](const Clash& clash) { return static_cast<unsigned>(clash.kind); });
        side("a", 0);
        side("b", 1);
        out.member("rule", rule_index_);
        column("distance", [](const Clash& clash) { return json_number(clash.distance); });
        column("triangle_pairs", [](const Clash& clash) { return clash.triangle_pairs; });
        column("point_a", [](const Clash& clash) { return json_point(clash.point_a); });
        column("point_b", [](const Clash& clash) { return json_point(clash.point_b); });
        column("direction", [](const Clash& clash) { return json_point(clash.direction); });
    }

    void write_statuses(JsonLines& out) const {
        write_texts(out, "notes", notes_);
        out.member("note", note_index_);
        write_column(out, "status", report_.clashes, [](const Clash& clash) {
            return static_cast<unsigned>(clash.status.value_or(ClashStatus::fresh));
        });
        write_resolved(out, report_);
    }

    const ClashReport& report_;
    const std::vector<Scene>& models_;
    std::unordered_map<const Part*, std::uint32_t> parts_;
    std::vector<const Part*> part_order_;
    std::vector<std::uint32_t> part_type_, part_file_;
    std::vector<std::array<std::uint32_t, 2>> part_index_; ///< by clash
    std::vector<std::uint32_t> rule_index_, note_index_;
    Table types_, files_, rules_, notes_;
};

/// Appends the template up to the marker, then removes that text and the marker from `html`.
void append_until(std::string& out, std::string_view& html, std::string_view marker) {
    const std::size_t at = html.find(marker);
    out += html.substr(0, at);
    html.remove_prefix(at + marker.size());
}

} // namespace

void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path) {
    std::string out;
    std::string_view html = report_page::html;
    append_until(out, html, "@STYLE@");
    out += report_page::style;
    append_until(out, html, "@DATA@");
    out += PageData(report, models).json();
    append_until(out, html, "@SCRIPT@");
    out += report_page::script;
    out += html;
    write_file_atomically(path, out);
}

} // namespace abut
