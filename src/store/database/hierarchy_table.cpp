#include "store/database/hierarchy_table.h"

#include "store/database/row_hash.h"
#include "tree/outline.h"

#include <span>
#include <string_view>

namespace abut {

namespace {

constexpr std::string_view kTable = R"(CREATE TABLE hierarchy(
  block INTEGER PRIMARY KEY,
  block_checksum INTEGER NOT NULL,
  format INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL))";

/// True also for a foreign table of that name.
bool has_table_of_the_name(Database& database) {
    return database.number("SELECT count(*) FROM sqlite_schema WHERE name = 'hierarchy'") > 0;
}

} // namespace

std::uint64_t HierarchyRow::checksum() const {
    return RowHash()
        .add(block)
        .add(block_checksum)
        .add(TreeOutline::kFormat)
        .add_bytes(data)
        .value();
}

bool has_hierarchies(Database& database) {
    // Compares the table's definition, whose text SQLite stores unchanged.
    Statement find(database, "SELECT sql = ? FROM sqlite_schema WHERE name = 'hierarchy'");
    find.bind(kTable);
    return find.step() && find.integer(0) != 0;
}

void keep_hierarchies(Database& database, const std::vector<HierarchyRow>& rows) {
    if (rows.empty())
        return;
    if (!has_table_of_the_name(database))
        Statement(database, kTable).run();
    if (!has_hierarchies(database))
        return;
    // INSERT OR REPLACE is not used: SQLite keeps a statement journal for each one.
    Statement remove(database, "DELETE FROM hierarchy WHERE block = ?");
    Statement add(database, "INSERT INTO hierarchy VALUES (?,?,?,?,?)");
    for (const HierarchyRow& row : rows) {
        remove.bind(row.block).run();
        add.bind(row.block, row.block_checksum, TreeOutline::kFormat, row.checksum(), row.data)
            .run();
    }
}

void remove_lost_hierarchies(Database& database) {
    if (has_hierarchies(database))
        database.run("DELETE FROM hierarchy WHERE block NOT IN (SELECT block FROM block)");
}

std::optional<HierarchyRow> read_hierarchy_row(const Statement& row, std::uint64_t block_checksum) {
    const std::span<const std::byte> data = row.bytes(4);
    HierarchyRow result{row.integer(0), static_cast<std::uint64_t>(row.integer(1)),
                        std::vector<std::byte>(data.begin(), data.end())};
    if (result.block_checksum != block_checksum ||
        row.integer(2) != std::int64_t{TreeOutline::kFormat} ||
        result.checksum() != static_cast<std::uint64_t>(row.integer(3)))
        return std::nullopt;
    return result;
}

} // namespace abut
