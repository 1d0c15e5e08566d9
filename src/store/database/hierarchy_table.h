#pragma once

#include "store/database/sqlite.h"

#include <cstdint>
#include <optional>
#include <vector>

/// The table of hierarchies. It is created when the first one is stored: stores without hierarchies
/// do not have it. docs/store.md explains the columns.
namespace abut {

/// The outline of one mesh block's hierarchy. It records which content of the block it belongs to,
/// since the number of a removed block may be reused.
struct HierarchyRow {
    std::int64_t block = 0;
    std::uint64_t block_checksum = 0; ///< checksum of the block's data
    std::vector<std::byte> data;      ///< as packed by encode_hierarchy

    [[nodiscard]] std::uint64_t checksum() const;
};

/// Whether the table exists, with the definition of this version.
bool has_hierarchies(Database& database);

/// Stores hierarchies, in place of older ones of the same blocks. Does nothing if there is a
/// foreign table of this name. Call it within a transaction.
void keep_hierarchies(Database& database, const std::vector<HierarchyRow>& rows);

/// Removes the hierarchies of blocks that no longer exist. Call it within a transaction.
void remove_lost_hierarchies(Database& database);

/// Reads one hierarchy: bind the number of a block, then step.
inline constexpr const char* kFindHierarchy =
    "SELECT block, block_checksum, format, checksum, data FROM hierarchy WHERE block = ?";
/// Returns none if the row has another format or belongs to other content, or if its checksum does
/// not match.
std::optional<HierarchyRow> read_hierarchy_row(const Statement& row, std::uint64_t block_checksum);

} // namespace abut
