#pragma once

#include "massive/work/block_cache.h"
#include "massive/work/stored_parts.h"
#include "rigid/model/model_blocks.h"
#include "store/model_reader.h"

#include <cstdint>
#include <map>
#include <memory>

namespace abut {

/// The large meshes that a worker needs. Their blocks are read when they are asked for.
class LargeMeshes {
public:
    /// In          budget: bytes of blocks in memory; reader: must outlive this object.
    LargeMeshes(ModelReader& reader, std::uint64_t budget);
    ~LargeMeshes();

    /// Returns the blocks of a mesh. Calls must not overlap; results of earlier calls may be in use
    /// meanwhile.
    /// In          mesh: row in the store.
    /// Errors      those of the store.
    const ModelBlocks& open(std::int64_t mesh);

    /// The number of threads whose blocks fit into the budget, given the largest block opened so
    /// far.
    [[nodiscard]] int threads() const;

    [[nodiscard]] const BlockCache& cache() const { return cache_; }
    /// Compressed bytes of the blocks that were read, each counted once.
    [[nodiscard]] std::uint64_t bytes_needed() const;

private:
    class Blocks;

    StoreFile& store_;
    std::uint64_t budget_;
    BlockCache cache_;
    std::map<std::int64_t, std::unique_ptr<const Blocks>> meshes_; ///< by store row
    std::uint64_t largest_block_ = 0;
};

/// The least budget, in bytes of blocks, with which one thread can work.
std::uint64_t least_for_blocks(const StoredParts& stored);

} // namespace abut
