#pragma once

#include "core/large_pages.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// A growing set of numbers. Any number of threads may insert at the same time, unless it is made
/// for one thread alone: then it has no locks.
///
/// Source      open addressing with linear probing, in shards that have a lock each.
class ConcurrentSet {
public:
    /// In: alone, whether one thread at a time uses the set.
    explicit ConcurrentSet(bool alone) : alone_(alone) {}

    /// Inserts a number. Returns true if it was not in the set. In: any number but ~0.
    bool insert(std::uint64_t number) {
        if (alone_)
            return shards_[0].insert(number);
        Shard& shard = shards_[hash_of(number) >> (64 - kShardBits)];
        const std::scoped_lock lock(shard.mutex);
        return shard.insert(number);
    }
    /// Begins to fetch the memory that insert(number) will look at. Does nothing in a set for several
    /// threads, whose memory may move meanwhile.
    void prefetch(std::uint64_t number) const {
        if (alone_)
            shards_[0].prefetch(number);
    }

private:
    static constexpr int kShardBits = 8;
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};

    /// Fibonacci hashing: the upper bits are well mixed.
    static std::uint64_t hash_of(std::uint64_t number) { return number * 0x9e3779b97f4a7c15U; }

    struct Shard {
        std::mutex mutex;
        std::vector<std::uint64_t> slots = std::vector<std::uint64_t>(64, kFree);
        std::size_t used = 0;

        bool insert(std::uint64_t number) {
            std::uint64_t& slot = find(number);
            if (slot == number)
                return false;
            slot = number;
            if (2 * ++used > slots.size())
                grow();
            return true;
        }
        void prefetch(std::uint64_t number) const {
#if defined(__GNUC__)
            __builtin_prefetch(&slots[first_place(number)]);
#else
            static_cast<void>(number);
#endif
        }
        /// Where the probe for a number starts: at the hash bits below those that chose the shard.
        [[nodiscard]] std::size_t first_place(std::uint64_t number) const {
            return (hash_of(number) << kShardBits >> 32) & (slots.size() - 1);
        }
        /// The number's slot, or the free slot where it belongs.
        std::uint64_t& find(std::uint64_t number) {
            std::size_t i = first_place(number);
            while (slots[i] != number && slots[i] != kFree)
                i = (i + 1) & (slots.size() - 1);
            return slots[i];
        }
        void grow() {
            std::vector<std::uint64_t> old;
            reserve_in_large_pages(old, 2 * slots.size());
            old.assign(2 * slots.size(), kFree);
            old.swap(slots);
            for (const std::uint64_t number : old)
                if (number != kFree)
                    find(number) = number;
        }
    };
    bool alone_;
    std::array<Shard, std::size_t{1} << kShardBits> shards_;
};

} // namespace abut
