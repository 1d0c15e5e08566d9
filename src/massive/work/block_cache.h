#pragma once

#include "rigid/model/model_blocks.h"
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

/// One mesh block of a large mesh in a store.
struct StoredBlock {
    std::int64_t row = 0;    ///< row in the store
    Box3 box;                ///< in the mesh's frame; empty if the block has no triangles
    std::uint64_t bytes = 0; ///< estimated size of its ModelBlock
};

/// Returns the blocks of a mesh in stored order.
///
/// Errors      those of the store.
std::vector<StoredBlock> stored_blocks(StoreFile& store, const MeshRow& mesh);

/// A cache of mesh blocks with a memory budget. A block is read when it is first asked for; the
/// least recently used one is evicted first. Any number of threads may call get().
///
/// A block that a caller still holds or that is being read is not evicted. Only such blocks can
/// exceed the budget.
class BlockCache {
public:
    /// In          budget: bytes; the reader must outlive the cache.
    BlockCache(ModelReader& reader, std::uint64_t budget) : reader_(reader), budget_(budget) {}

    /// Errors      those of the store.
    [[nodiscard]] std::shared_ptr<const ModelBlock> get(const StoredBlock& block);

    /// How often a block was read, repeated reads included; the rows of the distinct blocks.
    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    [[nodiscard]] const std::unordered_set<std::int64_t>& distinct() const { return distinct_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }

private:
    struct Entry {
        std::shared_ptr<const ModelBlock> block; ///< null while a thread reads it
        std::uint64_t bytes = 0;
        std::list<std::int64_t>::iterator place; ///< position in order_
    };

    void make_room(std::uint64_t bytes);
    [[nodiscard]] std::shared_ptr<const ModelBlock> read(const StoredBlock& block);

    ModelReader& reader_;
    std::uint64_t budget_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unordered_map<std::int64_t, Entry> entries_; ///< by store row
    std::list<std::int64_t> order_;                   ///< rows, most recently used first
    std::unordered_set<std::int64_t> distinct_;
    std::uint64_t bytes_ = 0, peak_bytes_ = 0, loads_ = 0;
};

} // namespace abut
