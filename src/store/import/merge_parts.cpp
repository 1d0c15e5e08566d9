#include "store/import/merge_parts.h"

#include "core/progress.h"
#include "math/vector.h"
#include "store/database/precision_table.h"
#include "store/database/property_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut {

namespace {

/// Checksums of the relations of the parts that have any, by the parts' numbers in the file.
std::unordered_map<std::uint64_t, std::uint64_t> relation_checksums(const SceneSource& source) {
    std::unordered_map<std::uint64_t, std::vector<PartTie>> ties;
    PartSpool::Cursor parts(source.parts());
    for (const auto& [a, b, kind] : source.facts().relations) {
        ties[a].push_back({kind, true, parts.part(b).id});
        ties[b].push_back({kind, false, parts.part(a).id});
    }
    std::unordered_map<std::uint64_t, std::uint64_t> checksums;
    for (auto& [part, of_part] : ties)
        checksums.emplace(part, checksum_of(std::move(of_part)));
    return checksums;
}

/// Distinguishes -0 from 0, because a store returns exactly what the file holds.
bool same_bits(const Transform& a, const Transform& b) {
    return std::equal(a.m.begin(), a.m.end(), b.m.begin(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
}

class PartMerge {
public:
    PartMerge(const SceneSource& source, const ImportedGeometry& geometry, std::uint64_t generation,
              const Progress& progress, ModelRow& model, Database& database)
        : source_(source), geometry_(geometry), parts_(source.parts()), boxes_(geometry),
          properties_of_(source), relations_of_(relation_checksums(source)), properties_(database),
          generation_(generation), progress_(progress), model_(model), database_(database),
          find_(database,
                std::string("SELECT ") + kPartColumns + " FROM part WHERE model = ? AND id = ?"),
          // OR REPLACE is not used: SQLite keeps a statement journal for each one.
          add_(database, "INSERT INTO part VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"),
          add_box_(database, "INSERT OR FAIL INTO part_box VALUES (?,?,?,?,?,?,?)"),
          remove_(database, "DELETE FROM part WHERE part = ?"),
          remove_box_(database, "DELETE FROM part_box WHERE part = ?"),
          same_precision_(read_precision(database, model.model) == source.facts().precision),
          next_(database.number("SELECT seq FROM sqlite_sequence WHERE name = 'part'") + 1) {}

    PartChanges run() {
        std::vector<std::int64_t> known = known_parts();
        remove_relations(database_, model_.model);
        std::vector<bool> seen(known.size());
        ProgressMeter meter(progress_, "parts", source_.parts().size());
        model_.parts = source_.parts().size();
        model_.triangles = model_.parts_sum = 0;
        for (std::uint64_t i = 0; i < source_.parts().size(); ++i) {
            const std::vector<PartProperty> properties = properties_of_.of(i);
            PartRow part = row_of(i);
            part.properties = checksum_of(properties);
            if (const auto before = known.empty() ? std::nullopt : find(part.id)) {
                seen[static_cast<std::size_t>(
                    std::lower_bound(known.begin(), known.end(), before->part) - known.begin())] =
                    true;
                merge(*before, part, properties);
            } else {
                part.part = next_++;
                part.generation = generation_;
                add(part);
                add_box(part);
                properties_.add(part.part, properties);
                ++changes_.added;
            }
            if (!relations_of_.empty())
                numbers_.push_back(part.part);
            model_.parts_sum += part.checksum();
            meter.advance();
        }
        for (std::size_t i = 0; i < known.size(); ++i)
            if (!seen[i])
                remove(known[i]);
        write_relations(database_, source_.facts().relations, numbers_);
        if (!same_precision_)
            write_precision(database_, model_.model, source_.facts().precision);
        return changes_;
    }

private:
    std::vector<std::int64_t> known_parts() {
        std::vector<std::int64_t> known;
        Statement parts(database_, "SELECT part FROM part WHERE model = ? ORDER BY part");
        parts.bind(model_.model);
        while (parts.step())
            known.push_back(parts.integer(0));
        return known;
    }

    PartRow row_of(std::uint64_t number) {
        Part part = parts_.part(number);
        model_.triangles += geometry_.triangles[part.mesh];
        PartRow row;
        row.model = model_.model;
        row.number = number;
        row.mesh = geometry_.meshes[part.mesh];
        row.id = std::move(part.id);
        row.name = std::move(part.name);
        row.type = std::move(part.type);
        row.world_from_mesh = part.world_from_mesh;
        row.colour = part.colour;
        if (const auto found = relations_of_.find(number); found != relations_of_.end())
            row.relations = found->second;
        row.box = without_negative_zero(boxes_.box(number));
        return row;
    }

    std::optional<PartRow> find(const std::string& id) {
        find_.bind(model_.model, id);
        std::optional<PartRow> found;
        if (find_.step())
            found = read_part_row(find_, database_.path());
        find_.reset();
        return found;
    }

    void merge(const PartRow& before, PartRow& part, std::span<const PartProperty> properties) {
        part.part = before.part;
        part.generation = before.generation;
        const bool same_box = before.box == part.box;
        // Another precision of the file changes the touch tolerance of all its pairs.
        const bool same = same_precision_ && same_box && before.mesh == part.mesh &&
                          before.name == part.name && before.type == part.type &&
                          before.colour == part.colour && before.properties == part.properties &&
                          before.relations == part.relations &&
                          same_bits(before.world_from_mesh, part.world_from_mesh);
        if (same && before.number == part.number)
            return;
        if (!same) {
            part.generation = generation_;
            ++changes_.changed;
        }
        remove_.bind(part.part).run();
        add(part);
        if (before.properties != part.properties) {
            properties_.remove(part.part);
            properties_.add(part.part, properties);
        }
        if (!same_box) {
            remove_box_.bind(part.part).run();
            add_box(part);
        }
    }

    void add(const PartRow& part) {
        const Box3& box = part.box;
        add_.bind(part.part, part.model, part.number, part.mesh, part.id, part.name, part.type,
                  box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z,
                  std::as_bytes(std::span(part.world_from_mesh.m)), part.generation,
                  colour_text(part.colour), part.properties, part.relations, part.checksum())
            .run();
    }

    void add_box(const PartRow& part) {
        if (is_empty(part.box))
            return;
        const Box3& box = part.box;
        add_box_
            .bind(part.part, box.lower.x, box.upper.x, box.lower.y, box.upper.y, box.lower.z,
                  box.upper.z)
            .run();
    }

    void remove(std::int64_t part) {
        remove_.bind(part).run();
        remove_box_.bind(part).run();
        properties_.remove(part);
        ++changes_.removed;
    }

    const SceneSource& source_;
    const ImportedGeometry& geometry_;
    PartSpool::Cursor parts_;
    ImportedGeometry::BoxCursor boxes_;
    SceneSource::PropertyCursor properties_of_;
    std::unordered_map<std::uint64_t, std::uint64_t> relations_of_; ///< as relation_checksums
    PropertyWriter properties_;
    std::vector<std::int64_t> numbers_; ///< rows of the parts; empty if no part has a relation
    std::uint64_t generation_;
    const Progress& progress_;
    ModelRow& model_;
    Database& database_;
    Statement find_, add_, add_box_, remove_, remove_box_;
    bool same_precision_;
    std::int64_t next_;
    PartChanges changes_;
};

} // namespace

PartChanges merge_parts(const SceneSource& source, const ImportedGeometry& geometry,
                        std::uint64_t generation, const Progress& progress, ModelRow& model,
                        Database& database) {
    Transaction transaction(database);
    const PartChanges changes =
        PartMerge(source, geometry, generation, progress, model, database).run();
    model.importing = false;
    if (changes.any())
        model.generation = generation;
    put_model(model, database);
    transaction.commit();
    return changes;
}

void put_model(const ModelRow& model, Database& database) {
    const std::array<std::uint64_t, 2> hash{model.hash_low, model.hash_high};
    Statement put(database, "INSERT OR REPLACE INTO model VALUES "
                            "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    put.bind(model.model, model.file, model.path, model.bytes, model.modified,
             std::as_bytes(std::span(hash)), model.unit, model.importing ? 1 : 0, model.parts,
             model.triangles, model.generation, model.parts_sum, std::string(to_string(model.up)),
             std::string(to_string(model.world_up)), model.asked, model.notes, model.project,
             std::as_bytes(std::span(model.map_from_project.m)), model.checksum())
        .run();
}

} // namespace abut
