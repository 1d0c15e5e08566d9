#pragma once

#include <abut/types.h>

#include "core/hash.h"
#include "store/database/schema.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The tables of levels of detail: `level_chunk` and `level_tree`. They are created when levels are
/// first built. docs/store-tables.md explains the columns.
namespace abut {

/// A chunk of geometry, without its data.
struct LevelChunkRow {
    std::int64_t chunk = 0; ///< 0: not stored yet
    Hash128 key;            ///< of all that the chunk is made from
    std::uint32_t vertices = 0, triangles = 0;
    double error = 0; ///< bound of the distance from what it stands for; more where shades differ
    Box3 box;         ///< of the chunk and of what it stands for
    std::uint64_t bytes = 0, data_checksum = 0; ///< of the data

    [[nodiscard]] std::uint64_t checksum() const;
};

/// The format of chunks and of the tree. Raise it with every change of their bytes, of their
/// geometry or of the tables: levels of another format then count as outdated, and are made again.
inline constexpr std::uint32_t kLevelFormat = 3;

/// The content that the levels of a store are made from: all its parts as they are now, and the
/// format.
Hash128 level_content(const std::vector<ModelRow>& models, std::uint32_t format = kLevelFormat);

/// Returns whether both tables exist, with the definitions of this version.
bool has_level_tables(Database& database);

/// Creates the tables. Call it within a transaction.
///
/// Errors      Error{cannot_write} if the store has other tables of these names.
void create_level_tables(Database& database);

/// Reads and writes chunks through one connection.
class LevelChunks {
public:
    explicit LevelChunks(Database& database);

    /// Errors      of both: Error{malformed}, naming the store and the chunk, for damage.
    std::optional<LevelChunkRow> find(const Hash128& key);
    std::vector<std::byte> read(const LevelChunkRow& chunk);

    /// Adds a chunk and gives it a number. Call it within a transaction.
    void add(LevelChunkRow& chunk, std::span<const std::byte> data);

private:
    Database& database_;
    Statement find_, read_, add_;
    std::int64_t next_;
};

/// A chunk by its number.
///
/// Errors      Error{malformed}, naming the store and the chunk, if it is missing or damaged.
std::vector<std::byte> read_level_chunk_data(Database& database, std::int64_t chunk);

/// Compares all chunks and the tree with their checksums.
///
/// Errors      Error{malformed}, naming the store and the chunk.
void check_level_chunks(Database& database);

/// The packed tree and what it was built from. None if there is none.
struct LevelTreeData {
    Hash128 content;
    std::vector<std::byte> data;
};

/// Errors      Error{malformed}, naming the store, if the tree is damaged.
std::optional<LevelTreeData> read_level_tree_data(Database& database);
/// What the tree was built from, without reading it.
std::optional<Hash128> level_tree_content(Database& database);
/// Replaces the tree and removes the chunks that are not in it. Call it within a transaction.
///
/// In          used: rows of `level_chunk`, ascending.
void replace_level_tree(Database& database, const LevelTreeData& tree,
                        const std::vector<std::int64_t>& used);

} // namespace abut
