#include <abut/clash.h>
#include <abut/error.h>

#include "clash/report/clash_status_text.h"
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

    void append_to(TextBuffer& out) {
        append(out, "{");
        append_json_head(out, report_);
        append_parts(out);
        append_clashes(out);
        if (report_.statuses)
            append_statuses(out);
        append_json_tail(out, report_);
        append(out, "}");
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

    /// Appends `"name": [element(0),...,element(count - 1)],`.
    template <typename Element>
    static void append_column(TextBuffer& out, std::string_view name, std::size_t count,
                              const Element& element) {
        fmt::format_to(fmt::appender(out), "\"{}\": [", name);
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0)
                out.push_back(',');
            element(i);
        }
        append(out, "],\n");
    }

    static void append_texts(TextBuffer& out, std::string_view name, const Table& table) {
        append_column(out, name, table.values().size(),
                      [&](std::size_t i) { append_json_string(out, *table.values()[i]); });
    }

    void append_parts(TextBuffer& out) {
        append_texts(out, "types", types_);
        append_texts(out, "files", files_);
        append_texts(out, "rules", rules_);
        const std::size_t count = part_order_.size();
        append_column(out, "part_id", count,
                      [&](std::size_t i) { append_json_string(out, part_order_[i]->id); });
        append_column(out, "part_name", count,
                      [&](std::size_t i) { append_json_string(out, part_order_[i]->name); });
        append_column(out, "part_type", count, [&](std::size_t i) { put(out, part_type_[i]); });
        append_column(out, "part_file", count, [&](std::size_t i) { put(out, part_file_[i]); });
    }

    void append_clashes(TextBuffer& out) {
        const std::vector<Clash>& clashes = report_.clashes;
        const std::size_t count = clashes.size();
        const auto column = [&](std::string_view name, const auto& element) {
            append_column(out, name, count, [&](std::size_t i) { element(i, clashes[i]); });
        };
        column("id", [&](std::size_t, const Clash& clash) {
            fmt::format_to(fmt::appender(out), "\"{:016x}\"", clash.id);
        });
        column("kind", [&](std::size_t, const Clash& clash) {
            put(out, static_cast<std::uint64_t>(clash.kind));
        });
        column("a", [&](std::size_t i, const Clash&) { put(out, part_index_[i][0]); });
        column("b", [&](std::size_t i, const Clash&) { put(out, part_index_[i][1]); });
        column("rule", [&](std::size_t i, const Clash&) { put(out, rule_index_[i]); });
        column("distance",
               [&](std::size_t, const Clash& clash) { append_json_number(out, clash.distance); });
        column("triangle_pairs",
               [&](std::size_t, const Clash& clash) { put(out, clash.triangle_pairs); });
        column("point_a",
               [&](std::size_t, const Clash& clash) { append_json_point(out, clash.point_a); });
        column("point_b",
               [&](std::size_t, const Clash& clash) { append_json_point(out, clash.point_b); });
        column("direction",
               [&](std::size_t, const Clash& clash) { append_json_point(out, clash.direction); });
    }

    void append_statuses(TextBuffer& out) {
        append_texts(out, "notes", notes_);
        append_column(out, "note", note_index_.size(),
                      [&](std::size_t i) { put(out, note_index_[i]); });
        append_column(out, "status", report_.clashes.size(), [&](std::size_t i) {
            put(out,
                static_cast<std::uint64_t>(report_.clashes[i].status.value_or(ClashStatus::fresh)));
        });
        append_json_resolved(out, report_);
    }

    static void put(TextBuffer& out, std::uint64_t value) {
        fmt::format_to(fmt::appender(out), "{}", value);
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
void append_until(TextBuffer& out, std::string_view& html, std::string_view marker) {
    const std::size_t at = html.find(marker);
    append(out, html.substr(0, at));
    html.remove_prefix(at + marker.size());
}

} // namespace

void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path) {
    TextBuffer out;
    std::string_view html = report_page::html;
    append_until(out, html, "@STYLE@");
    append(out, report_page::style);
    append_until(out, html, "@DATA@");
    PageData(report, models).append_to(out);
    append_until(out, html, "@SCRIPT@");
    append(out, report_page::script);
    append(out, html);
    write_file_atomically(path, {out.data(), out.size()});
}

} // namespace abut
