#pragma once

#include <abut/model.h>

#include "rigid/model_blocks.h"
#include "store/hierarchy_table.h"
#include "store/store_file.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// Models of a store's meshes and blocks: with the hierarchies that are kept there, or with hierarchies
/// that are built, which wait here to be kept. From any thread.
///
/// A hierarchy can always be built: one that is damaged, of another format or of another content is as
/// none, and makes room for the one that is built.
///
/// Errors      of all members: those of the store.
class ModelReader {
public:
    /// In          room: bytes of hierarchies that may wait to be kept; 0 if none is to be. What has no
    ///             room is not kept. The store must outlive the reader.
    ModelReader(StoreFile& store, std::uint64_t room);

    [[nodiscard]] StoreFile& store() const { return store_; }

    Model read_mesh(std::int64_t mesh);
    ModelBlock read_block(std::int64_t block);

    /// What was built since the last call. From now on it is looked for in the store.
    std::vector<HierarchyRow> take_built();

    /// How many hierarchies were in the store.
    [[nodiscard]] std::uint64_t found() const { return found_; }

private:
    Model model_of(const BlockRow& row, Mesh mesh);

    StoreFile& store_;
    std::uint64_t room_;
    std::atomic<bool> are_kept_; ///< some, in the store
    std::atomic<std::uint64_t> found_{0};
    std::mutex mutex_; ///< of what follows
    std::vector<HierarchyRow> built_;
    std::uint64_t built_bytes_ = 0;
};

} // namespace abut
