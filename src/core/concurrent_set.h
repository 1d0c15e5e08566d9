#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// A growing set of numbers. Any number of threads may insert at the same time.
///
/// Source      open addressing with linear probing, in shards that have a lock each.
class ConcurrentSet {
public:
    /// Inserts a number. Returns true if it was not in the set. In: any number but ~0.
    bool insert(std::uint64_t number) {
        return shards_[hash_of(number) >> (64 - kShardBits)].insert(number);
    }

private:
    static constexpr int kShardBits = 8;
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};

    /// Fibonacci hashing: the upper bits are well mixed.
    static std::uint64_t hash_of(std::uint64_t number) { return number * 0x9e3779b97f4a7c15U; }

    struct Shard {
        std::mutex mutex;
        std::vector<std::uint64_t> slots;
        std::size_t used = 0;

        bool insert(std::uint64_t number) {
            const std::scoped_lock lock(mutex);
            if (2 * used >= slots.size())
                grow();
            std::uint64_t& slot = find(number);
            if (slot == number)
                return false;
            slot = number;
            ++used;
            return true;
        }
        /// The number's slot, or the free slot where it belongs. The probe starts at the hash bits
        /// below those that chose the shard.
        std::uint64_t& find(std::uint64_t number) {
            std::size_t i = (hash_of(number) << kShardBits >> 32) & (slots.size() - 1);
            while (slots[i] != number && slots[i] != kFree)
                i = (i + 1) & (slots.size() - 1);
            return slots[i];
        }
        void grow() {
            std::vector<std::uint64_t> old(slots.empty() ? 64 : 2 * slots.size(), kFree);
            old.swap(slots);
            for (const std::uint64_t number : old)
                if (number != kFree)
                    find(number) = number;
        }
    };
    std::array<Shard, std::size_t{1} << kShardBits> shards_;
};

} // namespace abut
