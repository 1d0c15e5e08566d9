#include "core/concurrent_set.h"
#include "core/parallel.h"

#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>

namespace abut {
namespace {

/// Numbers that differ in their upper bits alone, or in their lower ones alone.
std::uint64_t number(std::uint64_t i) {
    return i % 2 == 0 ? i << 30 : i;
}

TEST(ConcurrentSet, TakesEachNumberOnce) {
    for (const bool alone : {false, true}) {
        ConcurrentSet set(alone);
        for (int pass = 0; pass < 2; ++pass)
            for (std::uint64_t i = 0; i < 10000; ++i) {
                set.prefetch(number(i));
                EXPECT_EQ(set.insert(number(i)), pass == 0);
            }
    }
}

TEST(ConcurrentSet, ThreadsShareIt) {
    constexpr std::size_t kNumbers = 20000;
    ConcurrentSet set(false);
    std::atomic<std::size_t> taken = 0;
    parallel_for(4 * kNumbers, 16, [&](std::size_t i) {
        if (set.insert(number(i % kNumbers)))
            ++taken;
    });
    EXPECT_EQ(taken, kNumbers);
}

} // namespace
} // namespace abut
