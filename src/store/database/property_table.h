#pragma once

#include <abut/properties.h>

#include "io/scene/part_spool.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace abut {

/// One relation of a part, seen from that part.
struct PartTie {
    RelationKind kind = RelationKind::fills;
    bool is_first = false; ///< the part is `a` of the PartRelation
    std::string other;     ///< id of the other part
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 of a comparison for a pointer
    friend auto operator<=>(const PartTie&, const PartTie&) = default;
};

/// The columns `properties` and `relations` of a part: 0 for none, else XXH3 of the names and
/// values in order, or of the sorted relations. They do not depend on the numbers of rows.
std::uint64_t checksum_of(std::span<const PartProperty> properties);
std::uint64_t checksum_of(std::vector<PartTie> ties);

/// Creates the tables of properties and relations, and the view `property` of all three.
extern const char* const kPropertyTables;

/// Distinct texts with numbers: the table property_name or property_value.
class PropertyTexts {
public:
    /// In          table: "property_name" or "property_value".
    PropertyTexts(Database& database, const std::string& table);
    /// The number of a text, which is added to the table if it is not there.
    std::int64_t number_of(const std::string& text);

private:
    Statement find_, add_;
    std::int64_t next_;
    std::unordered_map<std::string, std::int64_t> recent_; ///< a part of the table
    std::size_t recent_bytes_ = 0;
};

/// Writes the properties of parts.
class PropertyWriter {
public:
    explicit PropertyWriter(Database& database);
    void add(std::int64_t part, std::span<const PartProperty> properties);
    void remove(std::int64_t part) { remove_.bind(part).run(); }

private:
    PropertyTexts names_, values_;
    Statement add_, remove_;
};

/// Removes all relations between parts of a model. Call it while its parts are there.
void remove_relations(Database& database, std::int64_t model);
/// Adds relations between parts.
///
/// In          rows: the parts that the relations name by their index.
void write_relations(Database& database, std::span<const PartRelation> relations,
                     std::span<const std::int64_t> rows);

/// Returns the names of all properties, ascending.
std::vector<std::string> property_names(Database& database);

/// Removes names and values that no part has any more.
void remove_unused_texts(Database& database);

/// Reads the properties of parts, in the order of the parts that are given.
///
/// Errors      Error{malformed}, naming the store, if they do not match a part's checksum, or if
///             there is no such part.
Properties read_properties(Database& database, std::span<const std::int64_t> parts);

/// Reads the properties of these names only. Their checksums are not compared, because those of a
/// part are about all of its properties; check_properties does it.
///
/// Cost        nothing for each part if no part of the store has such a property.
/// Errors      as above, for damaged texts.
Properties read_properties(Database& database, std::span<const std::int64_t> parts,
                           std::span<const std::string> names);

/// Reads the relations between parts of a list, as indices in it.
///
/// In          parts: rows, each once
/// Errors      Error{malformed}, naming the store.
std::vector<PartRelation> read_relations(Database& database, std::span<const std::int64_t> parts);

/// Calls take(a, b, kind) for each relation, in the order of the rows.
/// Errors      Error{malformed}, naming the store.
void for_each_relation(Database& database,
                       const std::function<void(std::int64_t, std::int64_t, RelationKind)>& take);

/// Reads all properties and relations, and compares them with the checksums of the parts.
///
/// Errors      Error{malformed}, naming the store and the part.
void check_properties(Database& database);

} // namespace abut
