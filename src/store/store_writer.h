#pragma once

#include "store/exclusive_store.h"
#include "store/mesh_draft.h"
#include "store/schema.h"
#include "store/sqlite.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// Writes meshes into a store, in transactions of bounded size. While it lives, no other process
/// can open the store.
///
/// A killed writer leaves whole transactions: meshes that no part uses yet, and blocks of a mesh that
/// is not there yet, which the next writer removes.
class StoreWriter {
public:
    /// In, errors  as ExclusiveStore.
    StoreWriter(const std::string& path, std::uint64_t cache, ExclusiveStore::IfMissing if_missing);

    /// The number of a mesh that is in the store. From any thread, as add_mesh.
    std::optional<std::int64_t> find_mesh(const Hash128& hash);

    /// Adds a mesh and all its blocks; if it is there already, its number.
    std::int64_t add_mesh(const MeshRow& mesh, std::vector<BlockDraft>& blocks);

    /// Adds a mesh that does not fit into the memory: its blocks one by one, then the mesh itself.
    /// Nothing else may be added in between.
    void add_block(BlockDraft& block);
    std::int64_t end_mesh(MeshRow mesh);

    /// Keeps what was added.
    void commit();
    /// Removes meshes that no part uses. Returns how many.
    std::uint64_t remove_unused_meshes();

    /// Closes a store that this writer has created, and leaves its path as it was before. A store that was
    /// there stays as it is. Nothing else may be called afterwards.
    void undo_creation() noexcept;

    /// For rows of models and parts; commit() first.
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
    /// Of the mesh that add_block adds to.
    std::uint64_t open_blocks_ = 0, open_raw_ = 0, open_stored_ = 0;
};

} // namespace abut
