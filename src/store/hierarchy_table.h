#pragma once

#include "store/sqlite.h"

#include <cstdint>
#include <optional>
#include <vector>

/// The table of hierarchies, which is made when the first one is kept: stores that have none are as they
/// always were. docs/store.md says what the columns mean.
namespace abut {

/// The outline of one block's hierarchy. It says which content of the block it belongs to, since the
/// number of a block that was removed may come again.
struct HierarchyRow {
    std::int64_t block = 0;
    std::uint64_t block_checksum = 0; ///< of the block's data
    std::vector<std::byte> data;      ///< as encode_hierarchy packs it

    [[nodiscard]] std::uint64_t checksum() const;
};

/// Whether there is the table, as this version makes it.
bool has_hierarchies(Database& database);

/// Keeps hierarchies, in place of others of the same blocks. Nothing is done if there is another table
/// of this name. Within a transaction.
void keep_hierarchies(Database& database, const std::vector<HierarchyRow>& rows);

/// Of blocks that are not there any more. Within a transaction.
void remove_lost_hierarchies(Database& database);

/// What reads one: bind the number of a block, step.
inline constexpr const char* kFindHierarchy =
    "SELECT block, block_checksum, format, checksum, data FROM hierarchy WHERE block = ?";
/// None if it is of another format or of another content, or not what its checksum says.
std::optional<HierarchyRow> read_hierarchy_row(const Statement& row, std::uint64_t block_checksum);

} // namespace abut
