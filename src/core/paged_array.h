#pragma once

#include "core/temporary_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace abut {

/// An array on disk with random access through a bounded cache of pages. Not thread-safe.
///
/// Source      a direct-mapped cache: neighbouring pages never evict each other.
template <typename Value>
class PagedArray {
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    /// In          count: number of elements; all are zero until they are set.
    PagedArray(const std::string& folder, std::uint64_t count, std::size_t memory)
        : file_(folder), count_(count) {
        const std::uint64_t pages = count / kPageValues + 1;
        const std::uint64_t most =
            std::max<std::uint64_t>(memory / (kPageValues * sizeof(Value)), 4);
        slots_.resize(std::min(pages, most));
        on_disk_.resize(pages);
    }

    /// Errors      of get and set: Error{cannot_write} if the disk is full.
    Value get(std::uint64_t i) { return slot_of(i).values[i % kPageValues]; }

    void set(std::uint64_t i, const Value& value) {
        Slot& slot = slot_of(i);
        slot.values[i % kPageValues] = value;
        slot.changed = true;
    }

    [[nodiscard]] std::uint64_t size() const noexcept { return count_; }

private:
    static constexpr std::uint64_t kPageValues = 2048;
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};

    struct Slot {
        std::uint64_t page = kNone;
        bool changed = false;
        std::vector<Value> values;
    };

    Slot& slot_of(std::uint64_t i) {
        const std::uint64_t page = i / kPageValues;
        Slot& slot = slots_[page % slots_.size()];
        if (slot.page != page)
            load(slot, page);
        return slot;
    }

    void load(Slot& slot, std::uint64_t page) {
        constexpr std::uint64_t kPageBytes = kPageValues * sizeof(Value);
        if (slot.changed) {
            file_.write(slot.page * kPageBytes, std::as_bytes(std::span(slot.values)));
            on_disk_[slot.page] = true;
        }
        slot.values.resize(kPageValues);
        if (on_disk_[page])
            file_.read(page * kPageBytes, std::as_writable_bytes(std::span(slot.values)));
        else
            std::fill(slot.values.begin(), slot.values.end(), Value{});
        slot.page = page;
        slot.changed = false;
    }

    TemporaryFile file_;
    std::uint64_t count_;
    std::vector<Slot> slots_;
    std::vector<bool> on_disk_;
};

} // namespace abut
