#include "store/database/property_table.h"

#include <abut/error.h>

#include "io/scene/property_table.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <optional>

namespace abut {

namespace {

/// Texts that PropertyTexts remembers, in bytes. It forgets them when they exceed this.
constexpr std::size_t kRecentBytes = std::size_t{2} << 20;
constexpr std::size_t kBytesAroundText = 64;

std::uint64_t text_checksum(std::string_view text) {
    return RowHash().add(text).value();
}

std::uint64_t relation_checksum(std::int64_t a, std::int64_t b, const std::string& kind) {
    return RowHash().add(a).add(b).add(kind).value();
}

[[noreturn]] void property_damage(const Database& database, const std::string& what) {
    throw Error(ErrorCode::malformed, database.path(), "is damaged: " + what);
}

std::optional<RelationKind> relation_kind_of(const std::string& word) {
    for (const RelationKind kind : {RelationKind::fills, RelationKind::connected,
                                    RelationKind::covers, RelationKind::part_of})
        if (word == to_string(kind))
            return kind;
    return std::nullopt;
}

/// Reads a table of texts. Remembers what it has read.
class TextReader {
public:
    TextReader(Database& database, const std::string& table)
        : database_(database), what_(table),
          find_(database, "SELECT text, checksum FROM " + table + " WHERE " +
                              table.substr(table.find('_') + 1) + " = ?") {}

    const std::string& text(std::int64_t number) {
        const auto known = known_.find(number);
        if (known != known_.end())
            return known->second;
        find_.bind(number);
        if (!find_.step())
            property_damage(database_, what_ + " " + std::to_string(number) + " is missing");
        std::string text = find_.text(0);
        if (text_checksum(text) != static_cast<std::uint64_t>(find_.integer(1)))
            property_damage(database_,
                            what_ + " " + std::to_string(number) + " does not match its checksum");
        find_.reset();
        if (known_bytes_ > kKnownBytes) {
            known_.clear();
            known_bytes_ = 0;
        }
        known_bytes_ += text.size() + kBytesAroundText;
        return known_.emplace(number, std::move(text)).first->second;
    }

private:
    static constexpr std::size_t kKnownBytes = std::size_t{8} << 20;

    Database& database_;
    std::string what_;
    Statement find_;
    std::unordered_map<std::int64_t, std::string> known_;
    std::size_t known_bytes_ = 0;
};

/// Reads the properties of one part after the other.
class PropertyReader {
public:
    explicit PropertyReader(Database& database)
        : database_(database), names_(database, "property_name"),
          values_(database, "property_value"),
          rows_(database, "SELECT name, value FROM part_property WHERE part = ? ORDER BY number") {}

    /// In          checksum: the part's column `properties`.
    std::vector<PartProperty> of(std::int64_t part, std::uint64_t checksum) {
        std::vector<PartProperty> properties;
        rows_.bind(part);
        while (rows_.step())
            properties.push_back({names_.text(rows_.integer(0)), values_.text(rows_.integer(1))});
        rows_.reset();
        if (checksum_of(properties) != checksum)
            property_damage(database_, "the properties of part " + std::to_string(part) +
                                           " do not match their checksum");
        return properties;
    }

private:
    Database& database_;
    TextReader names_, values_;
    Statement rows_;
};

struct StoredRelation {
    std::int64_t a = 0, b = 0;
    RelationKind kind = RelationKind::fills;
};

StoredRelation read_relation(const Statement& row, const Database& database) {
    const std::optional<RelationKind> kind = relation_kind_of(row.text(2));
    const StoredRelation relation{row.integer(0), row.integer(1),
                                  kind.value_or(RelationKind::fills)};
    if (!kind || relation_checksum(relation.a, relation.b, row.text(2)) !=
                     static_cast<std::uint64_t>(row.integer(3)))
        property_damage(database, "a relation of part " + std::to_string(relation.a) +
                                      " does not match its checksum");
    return relation;
}

/// Reads all relations of one part after the other, in both directions.
class TieReader {
public:
    explicit TieReader(Database& database)
        : database_(database),
          rows_(database, "SELECT r.a, r.b, r.kind, r.checksum, p.id FROM part_relation AS r "
                          "JOIN part AS p ON p.part = r.b WHERE r.a = ?1 UNION ALL "
                          "SELECT r.a, r.b, r.kind, r.checksum, p.id FROM part_relation AS r "
                          "JOIN part AS p ON p.part = r.a WHERE r.b = ?1") {}
    std::vector<PartTie> of(std::int64_t part) {
        std::vector<PartTie> ties;
        rows_.bind(part);
        while (rows_.step()) {
            const StoredRelation relation = read_relation(rows_, database_);
            ties.push_back({relation.kind, relation.a == part, rows_.text(4)});
        }
        rows_.reset();
        return ties;
    }

private:
    Database& database_;
    Statement rows_;
};

} // namespace

const char* const kPropertyTables = R"(
CREATE TABLE property_name(name INTEGER PRIMARY KEY, text TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE INDEX property_name_by_checksum ON property_name(checksum);
CREATE TABLE property_value(value INTEGER PRIMARY KEY, text TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE INDEX property_value_by_checksum ON property_value(checksum);
CREATE TABLE part_property(
  part INTEGER NOT NULL REFERENCES part,
  number INTEGER NOT NULL,
  name INTEGER NOT NULL REFERENCES property_name,
  value INTEGER NOT NULL REFERENCES property_value,
  PRIMARY KEY(part, number)) WITHOUT ROWID;
CREATE TABLE part_relation(
  a INTEGER NOT NULL REFERENCES part,
  b INTEGER NOT NULL REFERENCES part,
  kind TEXT NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(a, b, kind)) WITHOUT ROWID;
CREATE INDEX part_relation_by_b ON part_relation(b);
CREATE VIEW property(part, name, value) AS
  SELECT part, property_name.text, property_value.text
  FROM part_property JOIN property_name USING (name) JOIN property_value USING (value);
)";

std::uint64_t checksum_of(std::span<const PartProperty> properties) {
    if (properties.empty())
        return 0;
    RowHash hash;
    for (const auto& [name, value] : properties)
        hash.add(name).add(value);
    return hash.value();
}

std::uint64_t checksum_of(std::vector<PartTie> ties) {
    if (ties.empty())
        return 0;
    std::ranges::sort(ties);
    RowHash hash;
    for (const auto& [kind, is_first, other] : ties)
        hash.add(static_cast<std::uint32_t>(kind))
            .add(std::uint32_t{is_first ? 1U : 0U})
            .add(other);
    return hash.value();
}

PropertyTexts::PropertyTexts(Database& database, const std::string& table)
    : find_(database, "SELECT " + table.substr(table.find('_') + 1) + " FROM " + table +
                          " WHERE checksum = ? AND text = ?"),
      add_(database, "INSERT INTO " + table + " VALUES (?,?,?)"),
      next_(database.number(
                ("SELECT max(" + table.substr(table.find('_') + 1) + ") FROM " + table).c_str()) +
            1) {}

std::int64_t PropertyTexts::number_of(const std::string& text) {
    const auto recent = recent_.find(text);
    if (recent != recent_.end())
        return recent->second;
    const std::uint64_t checksum = text_checksum(text);
    find_.bind(checksum, text);
    const bool is_known = find_.step();
    const std::int64_t number = is_known ? find_.integer(0) : next_++;
    find_.reset();
    if (!is_known)
        add_.bind(number, text, checksum).run();
    if (recent_bytes_ > kRecentBytes) {
        recent_.clear();
        recent_bytes_ = 0;
    }
    recent_bytes_ += text.size() + kBytesAroundText;
    recent_.emplace(text, number);
    return number;
}

PropertyWriter::PropertyWriter(Database& database)
    : names_(database, "property_name"), values_(database, "property_value"),
      add_(database, "INSERT INTO part_property VALUES (?,?,?,?)"),
      remove_(database, "DELETE FROM part_property WHERE part = ?") {}

void PropertyWriter::add(std::int64_t part, std::span<const PartProperty> properties) {
    std::uint64_t number = 0;
    for (const auto& [name, value] : properties)
        add_.bind(part, number++, names_.number_of(name), values_.number_of(value)).run();
}

void remove_relations(Database& database, std::int64_t model) {
    Statement(database,
              "DELETE FROM part_relation WHERE a IN (SELECT part FROM part WHERE model = ?)")
        .bind(model)
        .run();
}

void write_relations(Database& database, std::span<const PartRelation> relations,
                     std::span<const std::int64_t> rows) {
    Statement add(database, "INSERT INTO part_relation VALUES (?,?,?,?)");
    for (const PartRelation& relation : relations) {
        const std::int64_t a = rows[relation.a], b = rows[relation.b];
        const std::string kind = to_string(relation.kind);
        add.bind(a, b, kind, relation_checksum(a, b, kind)).run();
    }
}

void remove_unused_texts(Database& database) {
    database.run("DELETE FROM property_name WHERE name NOT IN (SELECT name FROM part_property);"
                 "DELETE FROM property_value WHERE value NOT IN (SELECT value FROM part_property)");
}

Properties read_properties(Database& database, std::span<const std::int64_t> parts) {
    Statement sum(database, "SELECT properties FROM part WHERE part = ?");
    PropertyReader reader(database);
    PropertiesBuilder builder;
    for (const std::int64_t part : parts) {
        sum.bind(part);
        if (!sum.step())
            property_damage(database, "part " + std::to_string(part) + " is missing");
        const auto checksum = static_cast<std::uint64_t>(sum.integer(0));
        sum.reset();
        if (checksum != 0)
            for (const auto& [name, value] : reader.of(part, checksum))
                builder.add(name, value);
        builder.next_part();
    }
    return builder.finish(parts.size());
}

Properties read_properties(Database& database, std::span<const std::int64_t> parts,
                           std::span<const std::string> names) {
    std::unordered_map<std::int64_t, const std::string*> wanted;
    Statement find(database, "SELECT name FROM property_name WHERE text = ?");
    for (const std::string& name : names) {
        find.bind(name);
        while (find.step())
            wanted.emplace(find.integer(0), &name);
        find.reset();
    }
    if (wanted.empty())
        return {};
    PropertiesBuilder builder;
    TextReader values(database, "property_value");
    Statement rows(database,
                   "SELECT name, value FROM part_property WHERE part = ? ORDER BY number");
    for (const std::int64_t part : parts) {
        rows.bind(part);
        while (rows.step())
            if (const auto at = wanted.find(rows.integer(0)); at != wanted.end())
                builder.add(*at->second, values.text(rows.integer(1)));
        rows.reset();
        builder.next_part();
    }
    return builder.finish(parts.size());
}

void for_each_relation(Database& database,
                       const std::function<void(std::int64_t, std::int64_t, RelationKind)>& take) {
    Statement rows(database, "SELECT a, b, kind, checksum FROM part_relation");
    while (rows.step()) {
        const StoredRelation relation = read_relation(rows, database);
        take(relation.a, relation.b, relation.kind);
    }
}

std::vector<PartRelation> read_relations(Database& database, std::span<const std::int64_t> parts) {
    std::unordered_map<std::int64_t, std::uint32_t> place;
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        place.emplace(parts[i], i);
    std::vector<PartRelation> relations;
    Statement rows(database, "SELECT a, b, kind, checksum FROM part_relation WHERE a = ?");
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        rows.bind(parts[i]);
        while (rows.step()) {
            const StoredRelation relation = read_relation(rows, database);
            if (const auto b = place.find(relation.b); b != place.end())
                relations.push_back({i, b->second, relation.kind});
        }
        rows.reset();
    }
    sort_relations(relations);
    return relations;
}

void check_properties(Database& database) {
    Statement parts(database, "SELECT part, properties, relations FROM part");
    PropertyReader properties(database);
    TieReader ties(database);
    while (parts.step()) {
        const std::int64_t part = parts.integer(0);
        (void)properties.of(part, static_cast<std::uint64_t>(parts.integer(1)));
        if (checksum_of(ties.of(part)) != static_cast<std::uint64_t>(parts.integer(2)))
            property_damage(database, "the relations of part " + std::to_string(part) +
                                          " do not match their checksum");
    }
    if (database.number("SELECT count(*) FROM part_property WHERE part NOT IN "
                        "(SELECT part FROM part)") +
            database.number("SELECT count(*) FROM part_relation WHERE a NOT IN "
                            "(SELECT part FROM part) OR b NOT IN (SELECT part FROM part)") >
        0)
        property_damage(database, "properties or relations of a part that is missing");
}

std::vector<std::string> property_names(Database& database) {
    std::vector<std::string> names;
    Statement rows(database, "SELECT text FROM property_name ORDER BY text");
    while (rows.step())
        names.push_back(rows.text(0));
    return names;
}

} // namespace abut
