#include "massive/work/block_cache.h"

#include "core/parallel.h"
#include "rigid/model/model_data.h"

#include <algorithm>
#include <iterator>

namespace abut {

std::vector<StoredBlock> stored_blocks(StoreFile& store, const MeshRow& mesh) {
    constexpr std::uint64_t kBytesPerNumber = 4; // ModelBlock::numbers has one entry per triangle
    std::vector<StoredBlock> blocks;
    for (const BlockRow& block : store.blocks(mesh))
        blocks.push_back({block.block, block.box,
                          most_model_bytes(block.triangles, block.vertices) +
                              kBytesPerNumber * block.triangles});
    return blocks;
}

std::shared_ptr<const ModelBlock> BlockCache::get(const StoredBlock& block) {
    std::unique_lock lock(mutex_);
    while (true) {
        const auto known = entries_.find(block.row);
        if (known == entries_.end())
            break;
        if (known->second.block != nullptr) {
            order_.splice(order_.begin(), order_, known->second.place);
            return known->second.block;
        }
        changed_.wait(lock);
    }
    make_room(block.bytes);
    order_.push_front(block.row);
    entries_[block.row] = {nullptr, block.bytes, order_.begin()};
    bytes_ += block.bytes;
    peak_bytes_ = std::max(peak_bytes_, bytes_);
    ++loads_;
    distinct_.insert(block.row);
    lock.unlock();
    std::shared_ptr<const ModelBlock> result;
    try {
        result = read(block);
    } catch (...) {
        lock.lock();
        order_.erase(entries_[block.row].place);
        entries_.erase(block.row);
        bytes_ -= block.bytes;
        changed_.notify_all();
        throw;
    }
    lock.lock();
    entries_[block.row].block = result;
    changed_.notify_all();
    return result;
}

std::shared_ptr<const ModelBlock> BlockCache::read(const StoredBlock& block) {
    std::shared_ptr<const ModelBlock> result;
    // `isolated` keeps this thread from taking up the test of another pair while it waits. That
    // test might need this block too, and would never get it.
    isolated([&] { result = std::make_shared<const ModelBlock>(reader_.read_block(block.row)); });
    return result;
}

void BlockCache::make_room(std::uint64_t bytes) {
    for (auto at = order_.end(); bytes_ + bytes > budget_ && at != order_.begin();) {
        const auto candidate = std::prev(at);
        const auto entry = entries_.find(*candidate);
        // Evicting a block that is being read or that a caller holds would free no memory.
        if (entry->second.block == nullptr || entry->second.block.use_count() > 1) {
            at = candidate;
            continue;
        }
        bytes_ -= entry->second.bytes;
        entries_.erase(entry);
        at = order_.erase(candidate);
    }
}

} // namespace abut
