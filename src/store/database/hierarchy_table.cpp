#include "store/database/hierarchy_table.h"

#include "store/database/optional_table.h"
#include "store/database/row_hash.h"
#include "tree/outline.h"

#include <span>

namespace abut {

namespace {

constexpr OptionalTable kHierarchyTable{"hierarchy", R"(CREATE TABLE hierarchy(
  block INTEGER PRIMARY KEY,
  block_checksum INTEGER NOT NULL,
  format INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL))"};

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
    return kHierarchyTable.exists(database);
}

void keep_hierarchies(Database& database, const std::vector<HierarchyRow>& rows) {
    if (rows.empty())
        return;
    if (!kHierarchyTable.create(database))
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
