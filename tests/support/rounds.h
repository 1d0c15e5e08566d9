#pragma once

#include <algorithm>
#include <cstdlib>

namespace abut::test {

/// So many cases, times ABUT_TEST_ROUNDS; fewer, of thousands, under a sanitizer, which slows them
/// down.
inline int many(int count) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): tests set no environment
    const char* text = std::getenv("ABUT_TEST_ROUNDS");
    const int rounds = text != nullptr ? std::max(1, std::atoi(text)) : 1;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    if (count >= 1000)
        count /= 16;
#endif
    return count * rounds;
}

} // namespace abut::test
