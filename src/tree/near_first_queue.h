#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/container/small_vector.hpp>
#include <cstdint>

namespace abut {

/// A queue that returns an item of nearly the smallest key, in constant time. The square root of
/// the key is within 12 % of the smallest. Among items of one bucket, the last one added comes
/// first. Keys are squared distances, so they are not negative. A key that is not a number, which
/// says nothing about the distance, counts as 0.
///
/// The bits of a positive float grow with its value: the exponent and the first two bits of the
/// fraction give the bucket's number. Buckets are lists in one pool. A bit for each bucket tells
/// whether it has items.
///
///     bucket  0 .......................... 127
///     key     all below top / 2^32   ...   top and above
template <typename Item>
class NearFirstQueue {
public:
    /// `top` is a key that few exceed.
    explicit NearFirstQueue(float top) : top_(code(top)) { head_.fill(kNone); }

    [[nodiscard]] bool empty() const { return (filled_[0] | filled_[1]) == 0; }

    [[nodiscard]] std::size_t size() const { return size_; }

    void push(float key, const Item& item) {
        ++size_;
        const std::uint32_t bucket = bucket_of(key);
        std::uint32_t entry = free_;
        if (entry != kNone) {
            free_ = pool_[entry].next;
            pool_[entry] = {item, head_[bucket]};
        } else {
            entry = static_cast<std::uint32_t>(pool_.size());
            pool_.push_back({item, head_[bucket]});
        }
        head_[bucket] = entry;
        filled_[bucket / 64] |= std::uint64_t{1} << bucket % 64;
    }

    /// Removes and returns the next item. In: the queue is not empty.
    Item pop() {
        --size_;
        const std::uint32_t bucket = first_bucket();
        const std::uint32_t entry = head_[bucket];
        const Item item = pool_[entry].item;
        head_[bucket] = pool_[entry].next;
        pool_[entry].next = free_;
        free_ = entry;
        if (head_[bucket] == kNone)
            filled_[bucket / 64] &= ~(std::uint64_t{1} << bucket % 64);
        return item;
    }

    /// Whether all items have keys above `key`, as far as their buckets tell. In: not empty.
    [[nodiscard]] bool all_above(float key) const { return first_bucket() > bucket_of(key); }

private:
    static constexpr std::uint32_t kBuckets = 128, kNone = ~0U;

    static std::int32_t code(float key) {
        return static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(key) >> 21);
    }
    [[nodiscard]] std::uint32_t bucket_of(float key) const {
        if (!(key >= 0))
            return 0;
        constexpr std::int32_t kLast = kBuckets - 1;
        return static_cast<std::uint32_t>(std::clamp(kLast - (top_ - code(key)), 0, kLast));
    }
    [[nodiscard]] std::uint32_t first_bucket() const {
        return static_cast<std::uint32_t>(filled_[0] != 0 ? std::countr_zero(filled_[0])
                                                          : 64 + std::countr_zero(filled_[1]));
    }

    struct Entry {
        Item item;
        std::uint32_t next;
    };
    std::int32_t top_;
    std::size_t size_ = 0;
    std::array<std::uint64_t, 2> filled_{};
    std::array<std::uint32_t, kBuckets> head_{};
    std::uint32_t free_ = kNone;
    boost::container::small_vector<Entry, 256> pool_;
};

} // namespace abut
