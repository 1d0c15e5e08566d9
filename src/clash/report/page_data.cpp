#include "clash/report/page_data.h"

#include "clash/report/clash_json.h"
#include "clash/report/clash_text.h"
#include "clash/report/group_json.h"

#include <unordered_map>

namespace abut {

using nlohmann::ordered_json;

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

/// Appends an array: of(row) for each row.
template <typename Row, typename Of>
void write_column(JsonLines& out, std::string_view name, const std::vector<Row>& rows,
                  const Of& of) {
    ordered_json::array_t column;
    column.reserve(rows.size());
    for (const Row& row : rows)
        column.push_back(of(row));
    out.member(name, std::move(column));
}

void write_texts(JsonLines& out, std::string_view name, const Table& table) {
    write_column(out, name, table.values(), [](const std::string* text) { return *text; });
}

ordered_json rounded_point(const Vec3& v, double rounding) {
    return json_point({rounded(v.x, rounding), rounded(v.y, rounding), rounded(v.z, rounding)});
}

/// The columns of a page.
class PageColumns {
public:
    PageColumns(const ClashReport& report, const std::vector<Scene>& models,
                const PartNumbers& numbers)
        : report_(report), sides_(numbers.sides()) {
        for (const auto& [model, part] : numbers.places()) {
            parts_.push_back(&models[model].parts[part]);
            part_type_.push_back(types_.index(parts_.back()->type));
            part_file_.push_back(files_.index(models[model].file));
            add_properties(models[model].properties, part);
        }
        for (const Clash& clash : report.clashes) {
            rule_index_.push_back(rules_.index(clash.rule));
            note_index_.push_back(notes_.index(clash.note));
            severity_index_.push_back(severities_.index(clash.severity));
        }
    }

    void write(JsonLines& out) const {
        write_parts(out);
        if (!property_values_.values().empty())
            write_properties(out);
        write_clashes(out);
        if (report_.statuses)
            write_statuses(out);
    }

private:
    /// Adds the properties of the next part of the page.
    void add_properties(const Properties& properties, std::uint32_t part) {
        std::vector<std::uint32_t>& pairs = part_properties_.emplace_back();
        for (const Properties::Entry& entry : properties.of(part)) {
            pairs.push_back(property_names_.index(properties.names[entry.name]));
            pairs.push_back(property_values_.index(properties.values[entry.value]));
        }
    }

    void write_properties(JsonLines& out) const {
        write_texts(out, "property_names", property_names_);
        write_texts(out, "property_values", property_values_);
        out.member("part_properties", part_properties_);
    }

    void write_parts(JsonLines& out) const {
        write_texts(out, "types", types_);
        write_texts(out, "files", files_);
        write_texts(out, "rules", rules_);
        write_column(out, "part_id", parts_, [](const Part* part) { return part->id; });
        write_column(out, "part_name", parts_, [](const Part* part) { return part->name; });
        out.member("part_type", part_type_);
        out.member("part_file", part_file_);
    }

    void write_clashes(JsonLines& out) const {
        const auto column = [&](std::string_view name, const auto& of) {
            write_column(out, name, report_.clashes, of);
        };
        const auto side = [&](std::string_view name, std::size_t k) {
            write_column(out, name, sides_, [&](const auto& parts) { return parts.at(k); });
        };
        column("id", [](const Clash& clash) { return clash_id_text(clash.id); });
        column("kind", [](const Clash& clash) { return static_cast<unsigned>(clash.kind); });
        side("a", 0);
        side("b", 1);
        out.member("rule", rule_index_);
        // The page exports the same numbers as write_clash_csv().
        column("distance", [](const Clash& clash) {
            return json_number(rounded(told_distance(clash), rounding_of_numbers(clash).distance));
        });
        column("triangle_pairs", [](const Clash& clash) { return clash.triangle_pairs; });
        column("point_a", [](const Clash& clash) {
            return rounded_point(clash.point_a, rounding_of_numbers(clash).points);
        });
        column("point_b", [](const Clash& clash) {
            return rounded_point(clash.point_b, rounding_of_numbers(clash).points);
        });
        column("direction", [](const Clash& clash) {
            return rounded_point(clash.direction, rounding_of_numbers(clash).direction);
        });
        column("volume", [](const Clash& clash) {
            return json_number(rounded(clash.volume, clash.volume_error));
        });
        column("volume_error", [](const Clash& clash) { return json_number(clash.volume_error); });
        column("neighbours", [](const Clash& clash) {
            return clash.neighbours ? to_string(*clash.neighbours) : "";
        });
        write_texts(out, "severities", severities_);
        out.member("severity", severity_index_);
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
    const std::vector<std::array<std::uint32_t, 2>>& sides_;
    std::vector<const Part*> parts_;
    std::vector<std::uint32_t> part_type_, part_file_;
    std::vector<std::uint32_t> rule_index_, note_index_, severity_index_;
    std::vector<std::vector<std::uint32_t>> part_properties_; ///< pairs of name and value, by part
    Table types_, files_, rules_, notes_, property_names_, property_values_, severities_;
};

/// A group with its clashes by number, as the page's list opens it.
ordered_json group_of_page(const ClashGroup& group) {
    ordered_json row{{"id", group.id}, {"name", group.name}, {"what", group.what}};
    if (group.change)
        put(row, "change", to_string(*group.change));
    ordered_json inner = ordered_json::array();
    for (const ClashGroup& one : group.groups)
        inner.push_back(group_of_page(one));
    put(row, "clashes", group.groups.empty() ? ordered_json(group.clashes) : ordered_json::array());
    put(row, "groups", std::move(inner));
    return row;
}

void write_page_groups(JsonLines& out, const ClashReport& report) {
    if (report.grouping.empty())
        return;
    out.member("grouping", to_string(report.grouping));
    if (!report.groups.empty())
        write_column(out, "groups", report.groups, group_of_page);
    if (!report.statuses)
        return;
    write_column(out, "history", report.history, [](const JobCounts& job) {
        return ordered_json{{"finished", job.finished},
                            {"kinds", job.kinds},
                            {"statuses", job.statuses},
                            {"groups", job.groups}};
    });
    write_column(out, "topics", report.topics, [](const Topic& topic) { return json_of(topic); });
    out.member("topics_revision", report.topics_revision);
}

void write_building(JsonLines& out, const PackedBuilding& building) {
    ordered_json chunks = ordered_json::array();
    for (const PackedBuilding::Chunk& chunk : building.chunks)
        chunks.push_back({chunk.vertices, chunk.indices, chunk.vertex_bytes, chunk.index_bytes});
    out.member("building", {{"chunks", std::move(chunks)},
                            {"meshes", building.meshes},
                            {"mesh_bytes", building.mesh_bytes},
                            {"parts", building.parts},
                            {"part_bytes", building.part_bytes},
                            {"transform_bytes", building.transform_bytes},
                            {"origin", json_point(building.origin)},
                            {"lower", json_point(building.bounds.lower)},
                            {"upper", json_point(building.bounds.upper)},
                            {"triangles", building.triangles},
                            {"left_out", building.left_out},
                            {"clash_share", json_number(building.clash_share)}});
}

} // namespace

PartNumbers::PartNumbers(const ClashReport& report, const std::vector<Scene>& models) {
    std::unordered_map<const Part*, std::uint32_t> numbers;
    for (const Clash& clash : report.clashes) {
        auto& sides = sides_.emplace_back();
        for (std::size_t side = 0; side < 2; ++side) {
            const Part& part = part_of(clash, static_cast<int>(side), models);
            const auto [entry, is_new] =
                numbers.try_emplace(&part, static_cast<std::uint32_t>(places_.size()));
            if (is_new)
                places_.push_back({clash.model.at(side), clash.part.at(side)});
            sides.at(side) = entry->second;
        }
    }
}

std::string page_data(const ClashReport& report, const std::vector<Scene>& models,
                      const PartNumbers& parts, const PackedBuilding& building) {
    JsonLines out;
    out.begin_object();
    write_head(out, report);
    PageColumns(report, models, parts).write(out);
    write_page_groups(out, report);
    if (!building.bytes.empty())
        write_building(out, building);
    write_tail(out, report);
    out.end_object();
    return out.take();
}

} // namespace abut
