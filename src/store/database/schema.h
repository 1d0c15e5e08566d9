#pragma once

#include <abut/scene.h>
#include <abut/types.h>

#include "store/database/sqlite.h"

#include <cstdint>
#include <optional>
#include <string>

namespace abut {

inline constexpr int kStoreVersion = 4;
/// Stored in the file's header, so that `file` and similar tools recognise a store: "Abut".
inline constexpr std::int64_t kApplicationId = 0x41627574;

/// Rows of the tables, each with its checksum. docs/store.md explains the columns.
struct ModelRow {
    std::int64_t model = 0;
    std::string file, path;
    std::uint64_t bytes = 0;
    std::int64_t modified = 0; ///< nanoseconds since 1970
    std::uint64_t hash_low = 0, hash_high = 0;
    double unit = 1; ///< metres per unit of the file
    bool importing = false;
    std::uint64_t parts = 0, triangles = 0, generation = 0;
    std::uint64_t parts_sum = 0; ///< sum of its parts' checksums, modulo 2^64
    UpAxis up = UpAxis::y;       ///< up axis of the file
    UpAxis world_up = UpAxis::y; ///< up axis of the parts' world: the same in all rows
    std::string asked;           ///< the import options that decide how the file is read
    std::string notes;           ///< as written by note_text
    std::string project;         ///< as Scene::project
    Transform map_from_project;  ///< as Scene::map_from_project

    [[nodiscard]] std::uint64_t checksum() const;
};

struct MeshRow {
    std::int64_t mesh = 0;
    std::uint64_t hash_low = 0, hash_high = 0;
    std::uint64_t vertices = 0, triangles = 0;
    std::int64_t first_block = 0;
    std::uint64_t blocks = 0;
    std::uint64_t raw_bytes = 0, stored_bytes = 0;
    /// The mesh bounds a solid. Of a mesh of several blocks: every edge is used by two triangles. None
    /// if the mesh was too large for the memory of the import.
    std::optional<bool> closed;
    Box3 box; ///< of the vertices that triangles use

    [[nodiscard]] std::uint64_t checksum() const;
};

struct BlockRow {
    std::int64_t block = 0, mesh = 0;
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t raw_bytes = 0;
    Box3 box; ///< of the vertices that its triangles use
    std::uint64_t data_checksum = 0;

    [[nodiscard]] std::uint64_t checksum() const;
};

struct PartRow {
    std::int64_t part = 0, model = 0;
    std::uint64_t number = 0;
    std::int64_t mesh = 0;
    std::string id, name, type;
    Transform world_from_mesh;
    Box3 box;
    std::uint64_t generation = 0;
    std::optional<Colour> colour;
    /// Checksums of its properties and relations (property_table.h); 0 for none.
    std::uint64_t properties = 0, relations = 0;

    [[nodiscard]] std::uint64_t checksum() const;
};

/// The column of a colour: as to_string writes it, or empty.
std::string colour_text(const std::optional<Colour>& colour);

/// Columns in the order that the read_… functions and the writer's statements use.
inline constexpr const char* kModelColumns =
    "model, file, path, bytes, modified, hash, unit, importing, parts, triangles, generation, "
    "parts_sum, up, world_up, asked, notes, project, map_from_project, checksum";
inline constexpr const char* kMeshColumns =
    "mesh, hash, vertices, triangles, first_block, blocks, raw_bytes, stored_bytes, closed, "
    "x0, y0, z0, x1, y1, z1, checksum";
inline constexpr const char* kBlockColumns =
    "block, mesh, vertices, triangles, raw_bytes, x0, y0, z0, x1, y1, z1, data_checksum, checksum, "
    "data";
/// The columns of a block without its data.
inline constexpr const char* kBlockRowColumns =
    "block, mesh, vertices, triangles, raw_bytes, x0, y0, z0, x1, y1, z1, data_checksum, checksum";
inline constexpr const char* kPartColumns =
    "part, model, number, mesh, id, name, type, x0, y0, z0, x1, y1, z1, world_from_mesh, "
    "generation, colour, properties, relations, checksum";

/// Reads the row that a statement stands on. Its columns are those above.
///
/// Errors      Error{malformed}, naming the store and the row, if the checksum does not match.
ModelRow read_model_row(const Statement& row, const std::string& store);
MeshRow read_mesh_row(const Statement& row, const std::string& store);
PartRow read_part_row(const Statement& row, const std::string& store);
BlockRow read_block_row(const Statement& row, const std::string& store);
/// The compressed bytes of the block, valid until the statement's next step.
std::span<const std::byte> read_block_data(const Statement& row, const BlockRow& block,
                                           const std::string& store);

/// Creates the tables in an empty file.
void create_schema(Database& database);

/// Checks that the file is a store of this version.
///
/// Errors      Error: malformed if the file is no store; unsupported if another version wrote it.
void check_schema(Database& database);

/// Replaces -0 by 0, since SQLite does not keep the sign of zero.
Box3 without_negative_zero(const Box3& box);

} // namespace abut
