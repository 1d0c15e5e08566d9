#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace abut {

/// A word as the float that Assimp makes of it, which is not always the nearest one: models that
/// are streamed must be those that read_scene gives, to the last bit.
///
/// In/out      plain numbers only, [+-] digits [. digits] [e [+-] digits], of not too many digits;
///             none for anything else, which is left to the isolated reader.
/// Source      what Assimp 5.2 computes: the whole part and at most 15 decimals, each rounded to
///             float by itself, then their sum times a power of ten in float.
inline std::optional<float> number_as_assimp(std::string_view word) {
    std::size_t i = 0;
    const auto is_digit = [&] { return i < word.size() && word[i] >= '0' && word[i] <= '9'; };
    const auto take_digits = [&](std::size_t most, std::uint64_t& value) {
        std::size_t count = 0;
        for (; is_digit() && count < most; ++i, ++count)
            value = 10 * value + static_cast<std::uint64_t>(word[i] - '0');
        return count;
    };
    const bool minus = !word.empty() && word[0] == '-';
    if (minus || (!word.empty() && word[0] == '+'))
        ++i;
    constexpr std::size_t kMostDigits = 18, kMostDecimals = 15, kMostExponent = 4;
    std::uint64_t whole = 0;
    if (take_digits(kMostDigits, whole) == 0 || is_digit())
        return std::nullopt;
    auto value = static_cast<float>(whole);
    if (i < word.size() && word[i] == '.') {
        ++i;
        std::uint64_t decimals = 0;
        const std::size_t count = take_digits(kMostDecimals, decimals);
        while (is_digit())
            ++i;
        constexpr std::array<double, kMostDecimals + 1> kTenths{
            0,    1e-1, 1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7,
            1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};
        if (count > 0)
            value += static_cast<float>(static_cast<double>(decimals) * kTenths.at(count));
    }
    if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
        ++i;
        const bool negative = i < word.size() && word[i] == '-';
        if (negative || (i < word.size() && word[i] == '+'))
            ++i;
        std::uint64_t digits = 0;
        if (take_digits(kMostExponent, digits) == 0)
            return std::nullopt;
        const auto exponent = static_cast<float>(digits);
        value *= std::pow(10.0F, negative ? -exponent : exponent);
    }
    if (i != word.size())
        return std::nullopt;
    return minus ? -value : value;
}

} // namespace abut
