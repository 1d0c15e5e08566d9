#include "core/set_bits.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace abut {
namespace {

template <typename Word>
std::vector<std::size_t> listed(Word bits) {
    std::vector<std::size_t> result;
    for (const std::size_t bit : SetBits(bits))
        result.push_back(bit);
    return result;
}

TEST(SetBits, AreListedFromTheLowest) {
    EXPECT_EQ(listed(std::uint32_t{0}), std::vector<std::size_t>{});
    EXPECT_EQ(listed(std::uint32_t{0b1011}), (std::vector<std::size_t>{0, 1, 3}));
    EXPECT_EQ(listed(std::uint32_t{1} << 31), std::vector<std::size_t>{31});
    EXPECT_EQ(listed(std::uint64_t{1} << 63 | 1), (std::vector<std::size_t>{0, 63}));
    EXPECT_EQ(listed(~std::uint64_t{0}).size(), 64U);
}

} // namespace
} // namespace abut
