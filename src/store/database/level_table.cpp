#include "store/database/level_table.h"

#include <abut/error.h>

#include "store/database/optional_table.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <cstring>

namespace abut {

namespace {

/// Bytes of the tree in one row.
constexpr std::size_t kPieceBytes = std::size_t{16} << 20;

constexpr OptionalTable kChunkTable{"level_chunk", R"(CREATE TABLE level_chunk(
  chunk INTEGER PRIMARY KEY AUTOINCREMENT,
  key BLOB NOT NULL UNIQUE,
  vertices INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  error REAL NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, z0 REAL NOT NULL,
  x1 REAL NOT NULL, y1 REAL NOT NULL, z1 REAL NOT NULL,
  bytes INTEGER NOT NULL,
  data_checksum INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL))"};

constexpr OptionalTable kTreeTable{"level_tree", R"(CREATE TABLE level_tree(
  piece INTEGER PRIMARY KEY,
  pieces INTEGER NOT NULL,
  content BLOB NOT NULL,
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL))"};

constexpr const char* kLevelChunkColumns =
    "chunk, key, vertices, triangles, error, x0, y0, z0, x1, y1, z1, bytes, data_checksum, "
    "checksum";

Hash128 hash_in(std::span<const std::byte> bytes) {
    Hash128 hash;
    if (bytes.size() == sizeof hash)
        std::memcpy(&hash, bytes.data(), sizeof hash);
    return hash;
}

std::span<const std::byte> bytes_of_hash(const Hash128& hash) {
    return std::as_bytes(std::span(&hash, 1));
}

[[noreturn]] void damaged_level(const std::string& store, std::int64_t chunk) {
    throw Error(ErrorCode::malformed, store,
                "is damaged: level chunk " + std::to_string(chunk) +
                    " does not match its checksum");
}

LevelChunkRow read_level_chunk_row(const Statement& row, const std::string& store) {
    LevelChunkRow result{
        row.integer(0),
        hash_in(row.bytes(1)),
        static_cast<std::uint32_t>(row.integer(2)),
        static_cast<std::uint32_t>(row.integer(3)),
        row.real(4),
        {{row.real(5), row.real(6), row.real(7)}, {row.real(8), row.real(9), row.real(10)}},
        static_cast<std::uint64_t>(row.integer(11)),
        static_cast<std::uint64_t>(row.integer(12))};
    if (result.checksum() != static_cast<std::uint64_t>(row.integer(13)))
        damaged_level(store, result.chunk);
    return result;
}

std::uint64_t piece_checksum(std::int64_t piece, std::int64_t pieces, const Hash128& content,
                             std::span<const std::byte> data) {
    return RowHash()
        .add(piece)
        .add(pieces)
        .add(content.low)
        .add(content.high)
        .add_bytes(data)
        .value();
}

} // namespace

std::uint64_t LevelChunkRow::checksum() const {
    return RowHash()
        .add(chunk)
        .add(key.low)
        .add(key.high)
        .add(vertices)
        .add(triangles)
        .add(error)
        .add(box)
        .add(bytes)
        .add(data_checksum)
        .value();
}

Hash128 level_content(const std::vector<ModelRow>& models, std::uint32_t format) {
    RowHash hash;
    hash.add(format);
    for (const ModelRow& model : models)
        hash.add(model.model).add(model.parts).add(model.parts_sum);
    return hash.value_128();
}

bool has_level_tables(Database& database) {
    return kChunkTable.exists(database) && kTreeTable.exists(database);
}

void create_level_tables(Database& database) {
    if (has_level_tables(database))
        return;
    if (database.number("SELECT count(*) FROM sqlite_schema "
                        "WHERE name IN ('level_chunk', 'level_tree')") > 0)
        throw Error(ErrorCode::cannot_write, database.path(),
                    "has other tables named level_chunk or level_tree: levels cannot be stored");
    Statement(database, kChunkTable.definition).run();
    Statement(database, kTreeTable.definition).run();
}

LevelChunks::LevelChunks(Database& database)
    : database_(database), find_(database, std::string("SELECT ") + kLevelChunkColumns +
                                               " FROM level_chunk WHERE key = ?"),
      read_(database, "SELECT data FROM level_chunk WHERE chunk = ?"),
      add_(database, "INSERT INTO level_chunk VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"),
      next_(database.number("SELECT seq FROM sqlite_sequence WHERE name = 'level_chunk'") + 1) {}

std::optional<LevelChunkRow> LevelChunks::find(const Hash128& key) {
    std::optional<LevelChunkRow> found;
    if (find_.bind(bytes_of_hash(key)).step())
        found = read_level_chunk_row(find_, database_.path());
    find_.reset();
    return found;
}

std::vector<std::byte> LevelChunks::read(const LevelChunkRow& chunk) {
    std::vector<std::byte> data;
    if (read_.bind(chunk.chunk).step()) {
        const std::span<const std::byte> stored = read_.bytes(0);
        data.assign(stored.begin(), stored.end());
    }
    read_.reset();
    if (hash_64(data) != chunk.data_checksum)
        damaged_level(database_.path(), chunk.chunk);
    return data;
}

void LevelChunks::add(LevelChunkRow& chunk, std::span<const std::byte> data) {
    chunk.chunk = next_++;
    chunk.bytes = data.size();
    chunk.data_checksum = hash_64(data);
    chunk.box = without_negative_zero(chunk.box);
    chunk.error += 0.0; // no -0
    const Box3& box = chunk.box;
    add_.bind(chunk.chunk, bytes_of_hash(chunk.key), chunk.vertices, chunk.triangles, chunk.error,
              box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z,
              chunk.bytes, chunk.data_checksum, chunk.checksum(), data)
        .run();
}

std::vector<std::byte> read_level_chunk_data(Database& database, std::int64_t chunk) {
    Statement row(database, std::string("SELECT ") + kLevelChunkColumns +
                                ", data FROM level_chunk WHERE chunk = ?");
    if (!row.bind(chunk).step())
        throw Error(ErrorCode::malformed, database.path(),
                    "is damaged: level chunk " + std::to_string(chunk) + " is missing");
    const std::span<const std::byte> data = row.bytes(14);
    if (hash_64(data) != read_level_chunk_row(row, database.path()).data_checksum)
        damaged_level(database.path(), chunk);
    return {data.begin(), data.end()};
}

void check_level_chunks(Database& database) {
    if (!has_level_tables(database))
        return;
    Statement rows(database,
                   std::string("SELECT ") + kLevelChunkColumns + ", data FROM level_chunk");
    while (rows.step()) {
        const LevelChunkRow row = read_level_chunk_row(rows, database.path());
        if (hash_64(rows.bytes(14)) != row.data_checksum)
            damaged_level(database.path(), row.chunk);
    }
    static_cast<void>(read_level_tree_data(database));
}

std::optional<LevelTreeData> read_level_tree_data(Database& database) {
    if (!has_level_tables(database))
        return std::nullopt;
    Statement rows(database,
                   "SELECT piece, pieces, content, checksum, data FROM level_tree ORDER BY piece");
    std::optional<LevelTreeData> tree;
    std::int64_t count = 0, expected = 0;
    const auto require = [&](bool sound) {
        if (!sound)
            throw Error(ErrorCode::malformed, database.path(),
                        "is damaged: the tree of levels does not match its checksum");
    };
    while (rows.step()) {
        const std::span<const std::byte> data = rows.bytes(4);
        const Hash128 content = hash_in(rows.bytes(2));
        if (!tree) {
            tree.emplace().content = content;
            expected = rows.integer(1);
        }
        require(rows.integer(0) == count++ && rows.integer(1) == expected &&
                content == tree->content &&
                piece_checksum(rows.integer(0), expected, content, data) ==
                    static_cast<std::uint64_t>(rows.integer(3)));
        tree->data.insert(tree->data.end(), data.begin(), data.end());
    }
    require(count == expected);
    return tree;
}

std::optional<Hash128> level_tree_content(Database& database) {
    if (!has_level_tables(database))
        return std::nullopt;
    Statement row(database, "SELECT content FROM level_tree WHERE piece = 0");
    if (!row.step())
        return std::nullopt;
    return hash_in(row.bytes(0));
}

void replace_level_tree(Database& database, const LevelTreeData& tree,
                        const std::vector<std::int64_t>& used) {
    database.run("DELETE FROM level_tree");
    Statement add(database, "INSERT INTO level_tree VALUES (?,?,?,?,?)");
    const std::span<const std::byte> all(tree.data);
    const auto pieces = static_cast<std::int64_t>(
        std::max<std::size_t>((all.size() + kPieceBytes - 1) / kPieceBytes, 1));
    for (std::int64_t i = 0; i < pieces; ++i) {
        const std::size_t from = static_cast<std::size_t>(i) * kPieceBytes;
        const std::span<const std::byte> data =
            all.subspan(from, std::min(kPieceBytes, all.size() - from));
        add.bind(i, pieces, bytes_of_hash(tree.content),
                 piece_checksum(i, pieces, tree.content, data), data)
            .run();
    }
    std::vector<std::int64_t> unused;
    {
        Statement rows(database, "SELECT chunk FROM level_chunk ORDER BY chunk");
        auto next = used.begin();
        while (rows.step()) {
            while (next != used.end() && *next < rows.integer(0))
                ++next;
            if (next == used.end() || *next != rows.integer(0))
                unused.push_back(rows.integer(0));
        }
    }
    Statement remove(database, "DELETE FROM level_chunk WHERE chunk = ?");
    for (const std::int64_t chunk : unused)
        remove.bind(chunk).run();
}

} // namespace abut
