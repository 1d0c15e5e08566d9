#include "store/database/schema.h"

#include <abut/error.h>

#include "store/database/property_table.h"
#include "store/database/row_hash.h"

#include <array>
#include <charconv>
#include <cstring>

namespace abut {

namespace {

Box3 read_box(const Statement& row, int at) {
    return {{row.real(at), row.real(at + 1), row.real(at + 2)},
            {row.real(at + 3), row.real(at + 4), row.real(at + 5)}};
}

void require(bool sound, const std::string& store, const char* table, std::int64_t row) {
    if (!sound)
        throw Error(ErrorCode::malformed, store,
                    std::string("is damaged: ") + table + " " + std::to_string(row) +
                        " does not match its checksum");
}

template <std::size_t count>
std::array<std::uint64_t, count> words(std::span<const std::byte> bytes) {
    std::array<std::uint64_t, count> result{};
    if (bytes.size() == sizeof result)
        std::memcpy(result.data(), bytes.data(), sizeof result);
    return result;
}

std::uint64_t unsigned_of(const Statement& row, int column) {
    return static_cast<std::uint64_t>(row.integer(column));
}

/// An unknown word gives z. The row is refused then, because its checksum does not match.
UpAxis up_of(const std::string& word) {
    return word == "x" ? UpAxis::x : word == "y" ? UpAxis::y : UpAxis::z;
}

/// Reads what colour_text has written. Of any other text, colour_text makes a different one.
std::optional<Colour> colour_of(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    std::array<std::uint8_t, 4> bytes{0, 0, 0, 255};
    for (std::size_t i = 0; i < 4 && 2 * i + 3 <= text.size(); ++i)
        std::from_chars(text.data() + 2 * i + 1, text.data() + 2 * i + 3, bytes[i], 16);
    return Colour{bytes[0], bytes[1], bytes[2], bytes[3]};
}

/// Returns false if the bytes are not those of a transform.
bool read_transform(std::span<const std::byte> bytes, Transform& transform) {
    if (bytes.size() != sizeof transform.m)
        return false;
    std::memcpy(transform.m.data(), bytes.data(), bytes.size());
    return true;
}

constexpr const char* kTables = R"(
CREATE TABLE model(
  model INTEGER PRIMARY KEY,
  file TEXT NOT NULL,
  path TEXT NOT NULL UNIQUE,
  bytes INTEGER NOT NULL,
  modified INTEGER NOT NULL,
  hash BLOB NOT NULL,
  unit REAL NOT NULL,
  importing INTEGER NOT NULL,
  parts INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  generation INTEGER NOT NULL,
  parts_sum INTEGER NOT NULL,
  up TEXT NOT NULL,
  world_up TEXT NOT NULL,
  asked TEXT NOT NULL,
  notes TEXT NOT NULL,
  project TEXT NOT NULL,
  map_from_project BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE mesh(
  mesh INTEGER PRIMARY KEY AUTOINCREMENT,
  hash BLOB NOT NULL UNIQUE,
  vertices INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  first_block INTEGER NOT NULL,
  blocks INTEGER NOT NULL,
  raw_bytes INTEGER NOT NULL,
  stored_bytes INTEGER NOT NULL,
  closed INTEGER,
  x0 REAL NOT NULL, y0 REAL NOT NULL, z0 REAL NOT NULL,
  x1 REAL NOT NULL, y1 REAL NOT NULL, z1 REAL NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE block(
  block INTEGER PRIMARY KEY,
  mesh INTEGER NOT NULL,
  vertices INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  raw_bytes INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, z0 REAL NOT NULL,
  x1 REAL NOT NULL, y1 REAL NOT NULL, z1 REAL NOT NULL,
  data_checksum INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL);
CREATE TABLE part(
  part INTEGER PRIMARY KEY AUTOINCREMENT,
  model INTEGER NOT NULL REFERENCES model,
  number INTEGER NOT NULL,
  mesh INTEGER NOT NULL REFERENCES mesh,
  id TEXT NOT NULL,
  name TEXT NOT NULL,
  type TEXT NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, z0 REAL NOT NULL,
  x1 REAL NOT NULL, y1 REAL NOT NULL, z1 REAL NOT NULL,
  world_from_mesh BLOB NOT NULL,
  generation INTEGER NOT NULL,
  colour TEXT NOT NULL,
  properties INTEGER NOT NULL,
  relations INTEGER NOT NULL,
  checksum INTEGER NOT NULL);
CREATE UNIQUE INDEX part_by_id ON part(model, id);
CREATE INDEX part_by_number ON part(model, number);
CREATE VIRTUAL TABLE part_box USING rtree(part, x0, x1, y0, y1, z0, z1);
)";

} // namespace

std::uint64_t ModelRow::checksum() const {
    return RowHash()
        .add(model)
        .add(file)
        .add(path)
        .add(bytes)
        .add(modified)
        .add(hash_low)
        .add(hash_high)
        .add(unit)
        .add(importing)
        .add(parts)
        .add(triangles)
        .add(generation)
        .add(parts_sum)
        .add(up)
        .add(world_up)
        .add(asked)
        .add(notes)
        .add(project)
        .add(map_from_project.m)
        .value();
}

std::uint64_t MeshRow::checksum() const {
    const int is_closed = closed ? (*closed ? 1 : 0) : -1;
    return RowHash()
        .add(mesh)
        .add(hash_low)
        .add(hash_high)
        .add(vertices)
        .add(triangles)
        .add(first_block)
        .add(blocks)
        .add(raw_bytes)
        .add(stored_bytes)
        .add(is_closed)
        .add(box)
        .value();
}

std::uint64_t BlockRow::checksum() const {
    return RowHash()
        .add(block)
        .add(mesh)
        .add(vertices)
        .add(triangles)
        .add(raw_bytes)
        .add(box)
        .add(data_checksum)
        .value();
}

std::uint64_t PartRow::checksum() const {
    return RowHash()
        .add(part)
        .add(model)
        .add(number)
        .add(mesh)
        .add(id)
        .add(name)
        .add(type)
        .add(box)
        .add(world_from_mesh.m)
        .add(generation)
        .add(colour_text(colour))
        .add(properties)
        .add(relations)
        .value();
}

std::string colour_text(const std::optional<Colour>& colour) {
    return colour ? to_string(*colour) : "";
}

ModelRow read_model_row(const Statement& row, const std::string& store) {
    const auto hash = words<2>(row.bytes(5));
    ModelRow result{row.integer(0),
                    row.text(1),
                    row.text(2),
                    unsigned_of(row, 3),
                    row.integer(4),
                    hash[0],
                    hash[1],
                    row.real(6),
                    row.integer(7) != 0,
                    unsigned_of(row, 8),
                    unsigned_of(row, 9),
                    unsigned_of(row, 10),
                    unsigned_of(row, 11),
                    up_of(row.text(12)),
                    up_of(row.text(13)),
                    row.text(14),
                    row.text(15),
                    row.text(16),
                    {}};
    const bool whole = read_transform(row.bytes(17), result.map_from_project);
    require(whole && result.checksum() == unsigned_of(row, 18), store, "model", result.model);
    return result;
}

MeshRow read_mesh_row(const Statement& row, const std::string& store) {
    const auto hash = words<2>(row.bytes(1));
    MeshRow result{row.integer(0),
                   hash[0],
                   hash[1],
                   unsigned_of(row, 2),
                   unsigned_of(row, 3),
                   row.integer(4),
                   unsigned_of(row, 5),
                   unsigned_of(row, 6),
                   unsigned_of(row, 7),
                   std::nullopt,
                   read_box(row, 9)};
    if (!row.is_null(8))
        result.closed = row.integer(8) != 0;
    require(result.checksum() == unsigned_of(row, 15), store, "mesh", result.mesh);
    return result;
}

BlockRow read_block_row(const Statement& row, const std::string& store) {
    BlockRow result{row.integer(0),      row.integer(1),   unsigned_of(row, 2), unsigned_of(row, 3),
                    unsigned_of(row, 4), read_box(row, 5), unsigned_of(row, 11)};
    require(result.checksum() == unsigned_of(row, 12), store, "block", result.block);
    return result;
}

std::span<const std::byte> read_block_data(const Statement& row, const BlockRow& block,
                                           const std::string& store) {
    const std::span<const std::byte> data = row.bytes(13);
    require(hash_64(data) == block.data_checksum, store, "block", block.block);
    return data;
}

PartRow read_part_row(const Statement& row, const std::string& store) {
    PartRow result{row.integer(0),
                   row.integer(1),
                   unsigned_of(row, 2),
                   row.integer(3),
                   row.text(4),
                   row.text(5),
                   row.text(6),
                   {},
                   read_box(row, 7),
                   unsigned_of(row, 14),
                   colour_of(row.text(15)),
                   unsigned_of(row, 16),
                   unsigned_of(row, 17)};
    const bool whole = read_transform(row.bytes(13), result.world_from_mesh) &&
                       colour_text(result.colour) == row.text(15);
    require(whole && result.checksum() == unsigned_of(row, 18), store, "part", result.part);
    return result;
}

void create_schema(Database& database) {
    Transaction transaction(database);
    const std::string header = "PRAGMA application_id = " + std::to_string(kApplicationId) +
                               "; PRAGMA user_version = " + std::to_string(kStoreVersion);
    database.run(header.c_str());
    database.run(kTables);
    database.run(kPropertyTables);
    transaction.commit();
}

void check_schema(Database& database) {
    database.require_pages();
    if (database.number("PRAGMA application_id") != kApplicationId)
        throw Error(ErrorCode::malformed, database.path(), "is not an Abut store");
    const std::int64_t version = database.number("PRAGMA user_version");
    if (version > kStoreVersion)
        throw Error(ErrorCode::unsupported, database.path(),
                    "is a store of version " + std::to_string(version) +
                        ", written by a newer Abut; this one reads version " +
                        std::to_string(kStoreVersion));
    constexpr std::array kMissing{"its axes", "colours", "properties"};
    if (version >= 1 && version < kStoreVersion)
        throw Error(ErrorCode::unsupported, database.path(),
                    "is a store of version " + std::to_string(version) +
                        ", which does not record " +
                        kMissing.at(static_cast<std::size_t>(version - 1)) +
                        ": import the models into a new one");
    if (version != kStoreVersion)
        throw Error(ErrorCode::malformed, database.path(),
                    "is damaged: it gives its version as " + std::to_string(version));
}

Box3 without_negative_zero(const Box3& box) {
    const auto positive = [](const Vec3& p) { return Vec3{p.x + 0.0, p.y + 0.0, p.z + 0.0}; };
    return {positive(box.lower), positive(box.upper)};
}

} // namespace abut
