#pragma once

#include <abut/model.h>

#include "rigid/model/model_blocks.h"
#include "store/database/hierarchy_table.h"
#include "store/database/store_file.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// Creates Models of a store's meshes and mesh blocks. It uses the hierarchies in the store;
/// missing ones are built, and wait here to be stored. May be used from any thread.
///
/// A hierarchy can always be rebuilt. One that is damaged, of another format or of other content
/// counts as missing, and is replaced by the one that is built.
///
/// Errors      of all members: those of the store.
class ModelReader {
public:
    /// In          room: bytes of built hierarchies that may wait; those beyond are discarded; 0 if
    ///             none is to be stored. The store must outlive the reader.
    ModelReader(StoreFile& store, std::uint64_t room);

    [[nodiscard]] StoreFile& store() const { return store_; }

    Model read_mesh(std::int64_t mesh);
    ModelBlock read_block(std::int64_t block);

    /// Returns the hierarchies built since the last call. The reader then expects the caller to
    /// store them, and looks for hierarchies in the store.
    std::vector<HierarchyRow> take_built();

    /// How many hierarchies were found in the store.
    [[nodiscard]] std::uint64_t found() const { return found_; }

private:
    Model model_of(const BlockRow& row, Mesh mesh);

    StoreFile& store_;
    std::uint64_t room_;
    std::atomic<bool> are_kept_; ///< whether the store has any hierarchies
    std::atomic<std::uint64_t> found_{0};
    std::mutex mutex_; ///< guards the members below
    std::vector<HierarchyRow> built_;
    std::uint64_t built_bytes_ = 0;
};

} // namespace abut
