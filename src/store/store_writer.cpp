#include "store/store_writer.h"

#include <abut/error.h>

#include "store/hierarchy_table.h"

#include <algorithm>
#include <sys/stat.h>
#include <utility>

namespace abut {

namespace {

/// What a killed import loses at most, and what one transaction may have to roll back.
constexpr std::uint64_t kTransactionBytes = std::uint64_t{16} << 20;

constexpr const char* kAddMesh = "INSERT INTO mesh VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";
constexpr const char* kAddBlock = "INSERT INTO block VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

std::span<const std::byte> bytes_of(const Hash128& hash) {
    return std::as_bytes(std::span(&hash, 1));
}

bool is_empty_or_missing(const std::string& path) {
    struct stat status {};
    return stat(path.c_str(), &status) != 0 || (S_ISREG(status.st_mode) && status.st_size == 0);
}

} // namespace

StoreWriter::StoreWriter(const std::string& path, std::uint64_t cache)
    : database_(path, OpenMode::create) {
    const bool is_new = is_empty_or_missing(path);
    database_.run(("PRAGMA cache_size = -" + std::to_string(cache >> 10)).c_str());
    database_.run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL");
    if (is_new)
        create_schema(database_);
    check_schema(database_);
    // The lock is taken by the first write and then kept.
    database_.run("BEGIN EXCLUSIVE; COMMIT");
    // The number of a mesh or a part that was removed never comes again.
    next_mesh_ = database_.number("SELECT seq FROM sqlite_sequence WHERE name = 'mesh'") + 1;
    next_block_ = database_.number("SELECT max(first_block + blocks) FROM mesh");
    next_block_ = std::max<std::int64_t>(next_block_, 1);
    // Of a mesh whose import was killed.
    if (database_.number("SELECT max(block) FROM block") >= next_block_) {
        Statement remove(database_, "DELETE FROM block WHERE block >= ?");
        remove.bind(next_block_).run();
    }
    find_mesh_.emplace(database_, "SELECT mesh FROM mesh WHERE hash = ?");
    add_mesh_.emplace(database_, kAddMesh);
    add_block_.emplace(database_, kAddBlock);
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
        transaction_.emplace(database_);
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
    Transaction transaction(database_);
    database_.run("CREATE TEMP TABLE unused AS SELECT mesh, first_block, blocks FROM mesh "
                  "WHERE mesh NOT IN (SELECT mesh FROM part)");
    const std::int64_t count = database_.number("SELECT count(*) FROM unused");
    if (count > 0) {
        {
            Statement unused(database_, "SELECT first_block, blocks FROM unused");
            Statement remove(database_, "DELETE FROM block WHERE block >= ? AND block < ?");
            while (unused.step())
                remove.bind(unused.integer(0), unused.integer(0) + unused.integer(1)).run();
        }
        database_.run("DELETE FROM mesh WHERE mesh IN (SELECT mesh FROM unused)");
        remove_lost_hierarchies(database_);
    }
    database_.run("DROP TABLE unused");
    transaction.commit();
    return static_cast<std::uint64_t>(count);
}

} // namespace abut
