#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Lists of integers as bytes that compress well: the lowest byte of each, then the second byte of
/// each, and so on.
namespace abut {

template <typename Word>
void append_planes(std::vector<std::byte>& out, std::span<const Word> words) {
    const std::size_t start = out.size();
    out.resize(start + words.size_bytes());
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane) {
        std::byte* const to = out.data() + start + plane * words.size();
        for (std::size_t i = 0; i < words.size(); ++i)
            to[i] = static_cast<std::byte>(words[i] >> (8 * plane));
    }
}

/// Takes the words from the beginning of `in` and removes them there. Returns false if `in` is too
/// short.
template <typename Word>
[[nodiscard]] bool take_planes(std::span<const std::byte>& in, std::span<Word> words) {
    if (in.size() < words.size_bytes())
        return false;
    std::fill(words.begin(), words.end(), Word{0});
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane) {
        const std::byte* const from = in.data() + plane * words.size();
        for (std::size_t i = 0; i < words.size(); ++i)
            words[i] |= static_cast<Word>(static_cast<Word>(from[i]) << (8 * plane));
    }
    in = in.subspan(words.size_bytes());
    return true;
}

/// Maps small differences of either sign to small numbers.
constexpr std::uint32_t zigzag(std::uint32_t difference) {
    return difference << 1 ^ (0 - (difference >> 31));
}
constexpr std::uint32_t unzigzag(std::uint32_t code) {
    return code >> 1 ^ (0 - (code & 1));
}

} // namespace abut
