#pragma once

#include "massive/block_cache.h"
#include "massive/stored_parts.h"
#include "rigid/model_blocks.h"
#include "store/model_reader.h"

#include <cstdint>
#include <map>
#include <memory>

namespace abut {

/// The large meshes that a worker meets, whose blocks come into memory as they are asked for.
class LargeMeshes {
public:
    /// In          budget: bytes of blocks; the reader must outlive this.
    LargeMeshes(ModelReader& reader, std::uint64_t budget);
    ~LargeMeshes();

    /// In          mesh: row of the store. Calls come one after the other; what an earlier one gave may
    ///             be used meanwhile.
    /// Errors      those of the store.
    const ModelBlocks& open(std::int64_t mesh);

    /// How many threads the budget has room for, with the blocks of what was opened.
    [[nodiscard]] int threads() const;

    [[nodiscard]] const BlockCache& cache() const { return cache_; }
    /// Compressed, of the blocks that were read, each once.
    [[nodiscard]] std::uint64_t bytes_needed() const;

private:
    class Blocks;

    StoreFile& store_;
    std::uint64_t budget_;
    BlockCache cache_;
    std::map<std::int64_t, std::unique_ptr<const Blocks>> meshes_; ///< by row
    std::uint64_t largest_block_ = 0;
};

/// Bytes for blocks below which not even one thread can work.
std::uint64_t least_for_blocks(const StoredParts& stored);

} // namespace abut
