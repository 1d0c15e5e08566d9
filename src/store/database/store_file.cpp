#include "store/database/store_file.h"

#include <abut/error.h>

#include "io/file/fault.h"
#include "store/database/folder_lock.h"
#include "store/database/precision_table.h"
#include "store/database/property_table.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

namespace abut {

namespace {

/// Rolls back a transaction that a killed import has left half done. Only a connection that may
/// write can do that.
void mend(const std::string& path) {
    if (!std::filesystem::exists(path + "-journal"))
        return;
    const FolderLock lock(path, FolderLock::Wait::yes);
    try {
        Database(path, OpenMode::read_write).number("SELECT count(*) FROM sqlite_schema");
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cannot_write)
            throw Error(ErrorCode::unreadable, path,
                        "was left half written by a killed import, and cannot be repaired because "
                        "it is read-only");
        throw;
    }
}

/// Throws if first_block is negative, or if first_block + blocks overflows int64.
void require_numbers(const MeshRow& mesh, const std::string& store) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
    if (mesh.first_block < 0 || mesh.blocks > kMost - static_cast<std::uint64_t>(mesh.first_block))
        throw Error(ErrorCode::malformed, store,
                    "is damaged: mesh " + std::to_string(mesh.mesh) + " has impossible blocks");
}

/// Begins to read, so that the checks and the statements that follow see one state of the file.
Database& begin_checked(Database& database) {
    database.run("BEGIN");
    check_schema(database);
    return database;
}

std::string select(const char* columns, const char* rest) {
    return std::string("SELECT ") + columns + " FROM " + rest;
}

} // namespace

StoreFile::Connection::Connection(const std::string& path, OpenMode mode)
    : database(path, mode),
      block(begin_checked(database), select(kBlockColumns, "block WHERE block = ?")),
      block_row(database, select(kBlockRowColumns, "block WHERE block = ?")),
      mesh(database, select(kMeshColumns, "mesh WHERE mesh = ?")),
      part(database, select(kPartColumns, "part WHERE part = ?")) {
    database.run("COMMIT");
    // A small page cache: callers keep the blocks that they read, so pages are not read twice.
    database.run("PRAGMA cache_size = -512");
}

StoreFile::Lease::Lease(StoreFile& file) : owner(file) {
    {
        const std::scoped_lock lock(file.mutex_);
        if (!file.idle_.empty()) {
            connection = std::move(file.idle_.back());
            file.idle_.pop_back();
        }
    }
    if (connection == nullptr)
        connection = std::make_unique<Connection>(file.path_, file.mode_);
}

StoreFile::Lease::~Lease() {
    connection->block.reset();
    connection->block_row.reset();
    connection->mesh.reset();
    connection->part.reset();
    if (connection->hierarchy)
        connection->hierarchy->reset();
    const std::scoped_lock lock(owner.mutex_);
    owner.idle_.push_back(std::move(connection));
}

StoreFile::StoreFile(std::string path, OpenMode mode) : path_(std::move(path)), mode_(mode) {
    if (mode == OpenMode::read_only)
        mend(path_);
    const Lease lease(*this);
}

StoreFile::~StoreFile() = default;

std::vector<ModelRow> StoreFile::models() {
    return with_connection([&](Database& database) {
        std::vector<ModelRow> models;
        Statement rows(database, select(kModelColumns, "model ORDER BY model"));
        while (rows.step())
            models.push_back(read_model_row(rows, path_));
        return models;
    });
}

void StoreFile::for_each_part(const std::function<void(const PartRow&)>& take) {
    for (const ModelRow& model : models())
        for_each_part(model, take);
}

void StoreFile::for_each_part(const ModelRow& model,
                              const std::function<void(const PartRow&)>& take) {
    with_connection([&](Database& database) {
        Statement rows(database,
                       select(kPartColumns, "part INDEXED BY part_by_number WHERE model = ? "
                                            "ORDER BY model, number"));
        std::uint64_t count = 0, sum = 0;
        rows.bind(model.model);
        while (rows.step()) {
            const PartRow part = read_part_row(rows, path_);
            if (part.number != count)
                break;
            ++count;
            sum += part.checksum();
            take(part);
        }
        // Detects rows that a damaged page hides.
        if (count != model.parts || sum != model.parts_sum)
            throw Error(ErrorCode::malformed, path_,
                        "is damaged: parts of model " + model.file + " are missing");
    });
}

ModelPrecision StoreFile::precision(std::int64_t model) {
    return with_connection([&](Database& database) { return read_precision(database, model); });
}

PartRow StoreFile::part(std::int64_t part) {
    Lease lease(*this);
    Statement& row = lease.connection->part;
    if (!row.bind(part).step())
        throw Error(ErrorCode::bad_argument, path_, "has no part " + std::to_string(part));
    return read_part_row(row, path_);
}

Properties StoreFile::properties(std::span<const std::int64_t> parts) {
    return with_connection([&](Database& database) { return read_properties(database, parts); });
}

Properties StoreFile::properties(std::span<const std::int64_t> parts,
                                 std::span<const std::string> names) {
    return with_connection(
        [&](Database& database) { return read_properties(database, parts, names); });
}

std::vector<PartRelation> StoreFile::relations(std::span<const std::int64_t> parts) {
    return with_connection([&](Database& database) { return read_relations(database, parts); });
}

void StoreFile::for_each_mesh(const std::function<void(const MeshRow&)>& take) {
    with_connection([&](Database& database) {
        Statement rows(database, select(kMeshColumns, "mesh ORDER BY mesh"));
        while (rows.step())
            take(read_mesh_row(rows, path_));
    });
}

MeshRow StoreFile::mesh(std::int64_t mesh) {
    Lease lease(*this);
    Statement& row = lease.connection->mesh;
    if (!row.bind(mesh).step())
        throw Error(ErrorCode::bad_argument, path_, "has no mesh " + std::to_string(mesh));
    return read_mesh_row(row, path_);
}

std::vector<BlockRow> StoreFile::blocks(const MeshRow& mesh) {
    require_numbers(mesh, path_);
    Lease lease(*this);
    Statement& row = lease.connection->block_row;
    std::vector<BlockRow> blocks;
    for (std::uint64_t i = 0; i < mesh.blocks; ++i) {
        if (!row.bind(mesh.first_block + static_cast<std::int64_t>(i)).step())
            throw Error(ErrorCode::malformed, path_,
                        "is damaged: a block of mesh " + std::to_string(mesh.mesh) + " is missing");
        blocks.push_back(read_block_row(row, path_));
    }
    return blocks;
}

StoredBlockData StoreFile::decode(const Statement& row) {
    const BlockRow block = read_block_row(row, path_);
    const std::span<const std::byte> data = read_block_data(row, block, path_);
    bytes_read_ += data.size();
    try {
        MeshBlock result = decode_block(data, block.raw_bytes);
        if (result.mesh.positions.size() != block.vertices ||
            result.mesh.triangles.size() != block.triangles)
            malformed("its sizes differ from those in its row");
        return {block, std::move(result)};
    } catch (const Fault& fault) {
        throw Error(ErrorCode::malformed, path_,
                    "is damaged: block " + std::to_string(block.block) + ": " + fault.what());
    }
}

StoredBlockData StoreFile::read_block_and_row(std::int64_t block) {
    Lease lease(*this);
    Statement& row = lease.connection->block;
    if (!row.bind(block).step())
        throw Error(ErrorCode::malformed, path_,
                    "is damaged: block " + std::to_string(block) + " is missing");
    return decode(row);
}

std::optional<HierarchyRow> StoreFile::find_hierarchy(const BlockRow& block) {
    std::optional<HierarchyRow> found;
    try {
        Lease lease(*this);
        std::optional<Statement>& row = lease.connection->hierarchy;
        if (!row)
            row.emplace(lease.connection->database, kFindHierarchy);
        if (row->bind(block.block).step())
            found = read_hierarchy_row(*row, block.data_checksum);
    } catch (const Error&) {
        return std::nullopt; // none: the caller builds it
    }
    if (found)
        bytes_read_ += found->data.size();
    return found;
}

namespace {

/// Assembles a mesh from its blocks.
class MeshAssembly {
public:
    explicit MeshAssembly(const MeshRow& row)
        : has_vertex_(row.vertices), has_triangle_(row.triangles) {
        mesh_.positions.resize(row.vertices);
        mesh_.triangles.resize(row.triangles);
    }

    /// Returns false if the block does not belong to the mesh.
    bool add(const MeshBlock& block) {
        const std::vector<std::uint32_t>& ids = block.vertex_ids;
        if ((!ids.empty() && ids.back() >= mesh_.positions.size()) ||
            (!block.triangle_ids.empty() && block.triangle_ids.back() >= mesh_.triangles.size()) ||
            ids.size() != block.mesh.positions.size() ||
            block.triangle_ids.size() != block.mesh.triangles.size())
            return false;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            mesh_.positions[ids[i]] = block.mesh.positions[i];
            vertices_ += has_vertex_[ids[i]] ? 0 : 1;
            has_vertex_[ids[i]] = true;
        }
        for (std::size_t i = 0; i < block.triangle_ids.size(); ++i) {
            const std::uint32_t id = block.triangle_ids[i];
            const auto& [a, b, c] = block.mesh.triangles[i];
            mesh_.triangles[id] = {ids[a], ids[b], ids[c]};
            triangles_ += has_triangle_[id] ? 0 : 1;
            has_triangle_[id] = true;
        }
        return true;
    }
    [[nodiscard]] bool is_whole() const {
        return vertices_ == mesh_.positions.size() && triangles_ == mesh_.triangles.size();
    }
    Mesh take() { return std::move(mesh_); }

private:
    Mesh mesh_;
    std::vector<bool> has_vertex_, has_triangle_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

[[noreturn]] void damaged_mesh(const std::string& store, std::int64_t mesh, const char* what) {
    throw Error(ErrorCode::malformed, store, "is damaged: mesh " + std::to_string(mesh) + what);
}

} // namespace

Mesh StoreFile::whole_mesh(const MeshRow& row, MeshBlock block) const {
    if (block.mesh.positions.size() != row.vertices || block.mesh.triangles.size() != row.triangles)
        damaged_mesh(path_, row.mesh, " has a block with other sizes");
    if (block.vertex_ids.empty() && block.triangle_ids.empty())
        return std::move(block.mesh);
    MeshAssembly assembly(row);
    if (!assembly.add(block) || !assembly.is_whole())
        damaged_mesh(path_, row.mesh, " is incomplete");
    return assembly.take();
}

Mesh StoreFile::read_mesh(std::int64_t mesh) {
    const MeshRow row = this->mesh(mesh);
    if (row.blocks == 1)
        return whole_mesh(row, read_block(row.first_block));
    // The blocks' sizes are checked first, so that a damaged row allocates no more than they hold.
    std::uint64_t vertices = 0, triangles = 0;
    for (const BlockRow& block : blocks(row)) {
        if (std::max(block.vertices, block.triangles) > kLargestBlockBytes)
            damaged_mesh(path_, mesh, " has a block that is too large");
        vertices += block.vertices, triangles += block.triangles;
    }
    if (row.vertices > vertices || row.triangles > triangles)
        damaged_mesh(path_, mesh, " is incomplete");
    MeshAssembly assembly(row);
    for (std::uint64_t i = 0; i < row.blocks; ++i)
        if (!assembly.add(read_block(row.first_block + static_cast<std::int64_t>(i))))
            damaged_mesh(path_, mesh, " has a block that does not belong to it");
    if (!assembly.is_whole())
        damaged_mesh(path_, mesh, " is incomplete");
    return assembly.take();
}

} // namespace abut
