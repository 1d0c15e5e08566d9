#pragma once

#include <algorithm>
#include <cstdlib>

namespace abut::test {

/// Number of cases to run: `count` times ABUT_TEST_ROUNDS. Under a sanitizer, which is slow, counts
/// in the thousands are reduced.
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
