#pragma once

namespace abut::test {

/// The value that a test uses: `reduced` under the thread sanitizer, which makes code some 30 times
/// slower, else `full`. For data with which a test would take more than 40 seconds there.
template <typename T>
constexpr T reduced_for_threads(T full, T reduced) {
#if defined(__SANITIZE_THREAD__) || defined(ABUT_REDUCED_TESTS)
    static_cast<void>(full);
    return reduced;
#else
    static_cast<void>(reduced);
    return full;
#endif
}

} // namespace abut::test
