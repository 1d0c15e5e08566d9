#include "core/large_pages.h"

#include <cstdint>
#include <sys/mman.h>

namespace abut {

void prefer_large_pages(const void* start, std::size_t bytes) noexcept {
    constexpr std::size_t kPage = std::size_t{2} << 20;
    const auto address = reinterpret_cast<std::uintptr_t>(start);
    const std::uintptr_t first = (address + kPage - 1) / kPage * kPage;
    const std::uintptr_t end = (address + bytes) / kPage * kPage;
    // This is only a hint: it has no effect where the system has no large pages.
    if (first < end)
        (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE); // NOLINT
}

} // namespace abut
