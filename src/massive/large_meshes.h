#pragma once

#include "massive/block_cache.h"
#include "massive/stored_parts.h"
#include "rigid/model_blocks.h"
#include "store/store_file.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace abut {

/// The large meshes of a job out of core, whose blocks come into memory as they are asked for.
class LargeMeshes {
public:
    /// In          budget: bytes of blocks; both others must outlive this.
    LargeMeshes(StoreFile& store, const StoredParts& stored, std::uint64_t budget);

    /// Null for a mesh that is whole.
    [[nodiscard]] const ModelBlocks* find(std::uint32_t mesh) const;

    /// Calls test(k) for each pair of a unit, in parallel: first those of whole meshes, then those
    /// of large ones, what lies together one after the other, by as many threads as the budget has
    /// room for.
    void for_each_pair(std::span<const IndexPair> pairs,
                       const std::function<void(std::size_t)>& test) const;

    [[nodiscard]] const BlockCache& cache() const { return cache_; }
    /// Compressed, of the blocks that were read, each once.
    [[nodiscard]] std::uint64_t bytes_needed() const;

private:
    class Blocks;

    [[nodiscard]] bool is_large(const IndexPair& pair) const;

    const StoredParts& stored_;
    BlockCache cache_;
    std::vector<std::unique_ptr<const ModelBlocks>> blocks_; ///< as StoredParts::large
    int threads_ = 1;
};

/// Bytes for blocks below which not even one thread can work.
std::uint64_t least_for_blocks(const StoredParts& stored);

} // namespace abut
