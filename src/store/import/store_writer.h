#pragma once

#include "store/database/exclusive_store.h"
#include "store/database/schema.h"
#include "store/database/sqlite.h"
#include "store/import/mesh_draft.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// Writes meshes into a store, in transactions of bounded size. No other process can open the store
/// during its lifetime.
///
/// A killed writer leaves only whole transactions behind. They may hold meshes that no part uses
/// yet, and blocks of a mesh that has no row yet; the next writer removes these blocks.
class StoreWriter {
public:
    /// In, errors  as ExclusiveStore.
    StoreWriter(const std::string& path, std::uint64_t cache, ExclusiveStore::IfMissing if_missing);

    /// The number of a mesh in the store, if it is there. May be called from any thread, as may
    /// add_mesh.
    std::optional<std::int64_t> find_mesh(const Hash128& hash);

    /// Adds a mesh and all its blocks. If it is there already, returns its number.
    std::int64_t add_mesh(const MeshRow& mesh, std::vector<BlockDraft>& blocks);

    /// Adds a mesh that does not fit into memory: first its blocks one by one, then the mesh
    /// itself. Nothing else may be added in between.
    void add_block(BlockDraft& block);
    std::int64_t end_mesh(MeshRow mesh);

    /// Commits what was added.
    void commit();
    /// Removes the meshes that no part uses, and returns how many there were.
    std::uint64_t remove_unused_meshes();

    /// Closes a store that this writer has created, and restores what was at its path before. A
    /// store that existed before stays as it is. Nothing else may be called afterwards.
    void undo_creation() noexcept;

    /// For rows of models and parts. Call commit() first.
    [[nodiscard]] Database& database() noexcept { return store_.database(); }
    [[nodiscard]] std::uint64_t new_meshes() const noexcept { return new_meshes_; }

private:
    void begin();
    void commit_if_large();

    std::mutex mutex_;
    ExclusiveStore store_;
    std::optional<Statement> find_mesh_, add_mesh_, add_block_;
    std::optional<Transaction> transaction_;
    std::int64_t next_mesh_ = 1, next_block_ = 1;
    std::uint64_t pending_bytes_ = 0;
    std::uint64_t new_meshes_ = 0;
    /// Counts of the mesh that add_block is adding to.
    std::uint64_t open_blocks_ = 0, open_raw_ = 0, open_stored_ = 0;
};

} // namespace abut
