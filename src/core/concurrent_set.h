#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// A set of numbers that grows, for any number of threads.
///
/// Source      open addressing with linear probing, in shards with a lock each.
class ConcurrentSet {
public:
    /// True if the number was not in the set. In: any but ~0.
    bool insert(std::uint64_t number) {
        return shards_[hash_of(number) >> (64 - kShardBits)].insert(number);
    }

private:
    static constexpr int kShardBits = 8;
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};

    /// Fibonacci hashing: the upper bits are the well mixed ones.
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
        /// Where the number is, or belongs: begins at the bits below those that chose the shard.
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
