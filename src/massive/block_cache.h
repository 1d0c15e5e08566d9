#pragma once

#include "rigid/model_blocks.h"
#include "store/model_reader.h"

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace abut {

/// A block of a large mesh of a store.
struct StoredBlock {
    std::int64_t row = 0;    ///< of the store
    Box3 box;                ///< in the mesh's frame; empty: it has no triangles
    std::uint64_t bytes = 0; ///< of a ModelBlock of it, estimated
};

/// The blocks of a mesh, in their order.
///
/// Errors      those of the store.
std::vector<StoredBlock> stored_blocks(StoreFile& store, const MeshRow& mesh);

/// Blocks of large meshes, as many as a number of bytes allows: read when they are asked for; what
/// was not asked for the longest goes first. Any number of threads may ask.
///
/// What somebody still holds cannot go: only that may exceed the budget.
class BlockCache {
public:
    /// In          budget: bytes; the reader must outlive the cache.
    BlockCache(ModelReader& reader, std::uint64_t budget) : reader_(reader), budget_(budget) {}

    /// Errors      those of the store.
    [[nodiscard]] std::shared_ptr<const ModelBlock> get(const StoredBlock& block);

    /// How many blocks were read, again and again included; how many of them are distinct.
    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    [[nodiscard]] const std::unordered_set<std::int64_t>& distinct() const { return distinct_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }

private:
    struct Entry {
        std::shared_ptr<const ModelBlock> block; ///< null: a thread is reading it
        std::uint64_t bytes = 0;
        std::list<std::int64_t>::iterator place; ///< in order_
    };

    void make_room(std::uint64_t bytes);
    [[nodiscard]] std::shared_ptr<const ModelBlock> read(const StoredBlock& block);

    ModelReader& reader_;
    std::uint64_t budget_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unordered_map<std::int64_t, Entry> entries_; ///< by row
    std::list<std::int64_t> order_;                   ///< rows, the last asked for first
    std::unordered_set<std::int64_t> distinct_;
    std::uint64_t bytes_ = 0, peak_bytes_ = 0, loads_ = 0;
};

} // namespace abut
