#include "store/import/store_writer.h"

#include <abut/error.h>

#include "store/database/hierarchy_table.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// Bytes after which a transaction is committed. They bound what a killed import loses, and what
/// may have to be rolled back.
constexpr std::uint64_t kTransactionBytes = std::uint64_t{16} << 20;

constexpr const char* kAddMesh = "INSERT INTO mesh VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";
constexpr const char* kAddBlock = "INSERT INTO block VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

std::span<const std::byte> bytes_of(const Hash128& hash) {
    return std::as_bytes(std::span(&hash, 1));
}

} // namespace

StoreWriter::StoreWriter(const std::string& path, std::uint64_t cache,
                         ExclusiveStore::IfMissing if_missing)
    : store_(path, cache, if_missing) {
    Database& database = store_.database();
    // Numbers of removed meshes and parts are never reused.
    next_mesh_ = database.number("SELECT seq FROM sqlite_sequence WHERE name = 'mesh'") + 1;
    next_block_ = database.number("SELECT max(first_block + blocks) FROM mesh");
    next_block_ = std::max<std::int64_t>(next_block_, 1);
    // Removes the blocks of a mesh whose import was killed.
    if (database.number("SELECT max(block) FROM block") >= next_block_) {
        Statement remove(database, "DELETE FROM block WHERE block >= ?");
        remove.bind(next_block_).run();
    }
    find_mesh_.emplace(database, "SELECT mesh FROM mesh WHERE hash = ?");
    add_mesh_.emplace(database, kAddMesh);
    add_block_.emplace(database, kAddBlock);
}

std::optional<std::int64_t> StoreWriter::find_mesh(const Hash128& hash) {
    const std::scoped_lock lock(mutex_);
    find_mesh_->bind(bytes_of(hash));
    std::optional<std::int64_t> found;
    if (find_mesh_->step())
        found = find_mesh_->integer(0);
    find_mesh_->reset();
    return found;
}

std::int64_t StoreWriter::add_mesh(const MeshRow& mesh, std::vector<BlockDraft>& blocks) {
    if (const auto found = find_mesh({mesh.hash_low, mesh.hash_high}))
        return *found;
    for (BlockDraft& block : blocks)
        add_block(block);
    return end_mesh(mesh);
}

void StoreWriter::add_block(BlockDraft& block) {
    const std::scoped_lock lock(mutex_);
    begin();
    BlockRow& row = block.row;
    row.block = next_block_++;
    row.mesh = next_mesh_;
    row.data_checksum = hash_64(block.data);
    const Box3& box = row.box;
    add_block_
        ->bind(row.block, row.mesh, row.vertices, row.triangles, row.raw_bytes, box.lower.x,
               box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z, row.data_checksum,
               row.checksum(), block.data)
        .run();
    ++open_blocks_;
    open_raw_ += row.raw_bytes;
    open_stored_ += block.data.size();
    pending_bytes_ += block.data.size();
    commit_if_large();
}

std::int64_t StoreWriter::end_mesh(MeshRow mesh) {
    const std::scoped_lock lock(mutex_);
    begin();
    mesh.mesh = next_mesh_++;
    mesh.blocks = std::exchange(open_blocks_, 0);
    mesh.first_block = next_block_ - static_cast<std::int64_t>(mesh.blocks);
    mesh.raw_bytes = std::exchange(open_raw_, 0);
    mesh.stored_bytes = std::exchange(open_stored_, 0);
    mesh.box = without_negative_zero(mesh.box);
    const Hash128 hash{mesh.hash_low, mesh.hash_high};
    const Box3& box = mesh.box;
    const auto add = [&](const auto& closed) {
        add_mesh_
            ->bind(mesh.mesh, bytes_of(hash), mesh.vertices, mesh.triangles, mesh.first_block,
                   mesh.blocks, mesh.raw_bytes, mesh.stored_bytes, closed, box.lower.x, box.lower.y,
                   box.lower.z, box.upper.x, box.upper.y, box.upper.z, mesh.checksum())
            .run();
    };
    if (mesh.closed)
        add(*mesh.closed ? 1 : 0);
    else
        add(nullptr);
    ++new_meshes_;
    pending_bytes_ += 256;
    commit_if_large();
    return mesh.mesh;
}

void StoreWriter::begin() {
    if (!transaction_)
        transaction_.emplace(database());
}

void StoreWriter::commit_if_large() {
    if (pending_bytes_ < kTransactionBytes)
        return;
    transaction_->commit();
    transaction_.reset();
    pending_bytes_ = 0;
}

void StoreWriter::commit() {
    const std::scoped_lock lock(mutex_);
    if (transaction_)
        transaction_->commit();
    transaction_.reset();
    pending_bytes_ = 0;
}

std::uint64_t StoreWriter::remove_unused_meshes() {
    commit();
    Database& database = store_.database();
    Transaction transaction(database);
    database.run("CREATE TEMP TABLE unused AS SELECT mesh, first_block, blocks FROM mesh "
                 "WHERE mesh NOT IN (SELECT mesh FROM part)");
    const std::int64_t count = database.number("SELECT count(*) FROM unused");
    if (count > 0) {
        {
            Statement unused(database, "SELECT first_block, blocks FROM unused");
            Statement remove(database, "DELETE FROM block WHERE block >= ? AND block < ?");
            while (unused.step())
                remove.bind(unused.integer(0), unused.integer(0) + unused.integer(1)).run();
        }
        database.run("DELETE FROM mesh WHERE mesh IN (SELECT mesh FROM unused)");
        remove_lost_hierarchies(database);
    }
    database.run("DROP TABLE unused");
    transaction.commit();
    return static_cast<std::uint64_t>(count);
}

void StoreWriter::undo_creation() noexcept {
    transaction_.reset();
    find_mesh_.reset();
    add_mesh_.reset();
    add_block_.reset();
    store_.undo_creation();
}

} // namespace abut
