#pragma once

#include <cstddef>
#include <vector>

namespace abut {

/// Asks the system for large pages in a range of unused memory. Without them, page faults take a
/// third of the time of filling the memory. Does nothing for a small range.
void prefer_large_pages(const void* start, std::size_t bytes) noexcept;

template <typename Value>
void reserve_in_large_pages(std::vector<Value>& values, std::size_t count) {
    values.reserve(count);
    prefer_large_pages(values.data(), values.capacity() * sizeof(Value));
}

} // namespace abut
