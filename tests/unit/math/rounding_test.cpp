#include "math/rounding.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>

namespace abut {
namespace {

template <std::size_t N>
[[gnu::noinline]] std::array<double, N> rounded(const std::array<double, N>& values) {
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i)
        result[i] = double{to_float(values[i])};
    return result;
}

/// Neighbours are what g++ 12 makes one vector operation, and then drops.
TEST(Rounding, ToFloatDropsDigitsOfNeighboursToo) {
    constexpr double kTenth = 0.1F; // the nearest float, as a double
    static_assert(kTenth != 0.1);
    EXPECT_EQ(rounded<1>({0.1}), (std::array{kTenth}));
    EXPECT_EQ(rounded<2>({0.1, 0.2}), (std::array{kTenth, 2 * kTenth}));
    EXPECT_EQ(rounded<3>({0.1, 0.2, 0.4}), (std::array{kTenth, 2 * kTenth, 4 * kTenth}));
    EXPECT_EQ(rounded<4>({0.1, 0.2, 0.4, 0.8}),
              (std::array{kTenth, 2 * kTenth, 4 * kTenth, 8 * kTenth}));
}

} // namespace
} // namespace abut
