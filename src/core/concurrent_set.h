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
        // Fibonacci hashing: the upper bits are the well mixed ones.
        const std::uint64_t hash = number * 0x9e3779b97f4a7c15U;
        return shards_[hash >> (64 - kShardBits)].insert(number, hash << kShardBits);
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t slots = 0;
        for (const Shard& shard : shards_)
            slots += shard.slots.size();
        return slots * sizeof(std::uint64_t);
    }

private:
    static constexpr int kShardBits = 8;
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};

    struct Shard {
        std::mutex mutex;
        std::vector<std::uint64_t> slots;
        std::size_t used = 0;

        bool insert(std::uint64_t number, std::uint64_t hash) {
            const std::scoped_lock lock(mutex);
            if (2 * used >= slots.size())
                grow();
            std::uint64_t& slot = find(number, hash);
            if (slot == number)
                return false;
            slot = number;
            ++used;
            return true;
        }
        /// Where the number is, or belongs.
        std::uint64_t& find(std::uint64_t number, std::uint64_t hash) {
            std::size_t i = (hash >> 32) & (slots.size() - 1);
            while (slots[i] != number && slots[i] != kFree)
                i = (i + 1) & (slots.size() - 1);
            return slots[i];
        }
        void grow() {
            std::vector<std::uint64_t> old(slots.empty() ? 64 : 2 * slots.size(), kFree);
            old.swap(slots);
            for (const std::uint64_t number : old)
                if (number != kFree)
                    find(number, number * 0x9e3779b97f4a7c15U << kShardBits) = number;
        }
    };
    std::array<Shard, std::size_t{1} << kShardBits> shards_;
};

} // namespace abut
