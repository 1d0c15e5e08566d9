#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {

/// A finite double as mantissa * 2^exponent, the mantissa odd (or both zero).
struct Binary {
    std::int64_t mantissa = 0;
    int exponent = 0;
};

/// The bits of a double:
///
///      63    62..52    51..0
///     sign  exponent  fraction, below an implicit 1 unless the exponent is 0
inline Binary decompose(double v) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    constexpr std::uint64_t kImplicit = std::uint64_t{1} << 52;
    std::uint64_t mantissa = bits & (kImplicit - 1);
    int exponent = static_cast<int>(bits >> 52 & 0x7ff);
    if (exponent != 0)
        mantissa |= kImplicit;
    else
        exponent = 1;
    if (mantissa == 0)
        return {};
    const int zeros = std::countr_zero(mantissa);
    const auto magnitude = static_cast<std::int64_t>(mantissa >> zeros);
    return {v < 0 ? -magnitude : magnitude, exponent - 1075 + zeros};
}

/// Doubles as integers in units of a common power of two. Signs do not depend on the unit.
template <std::size_t n>
struct Scaled {
    std::array<Binary, n> values;
    int least = 0; ///< exponent of the common unit
    int bits = 0;  ///< all integers are below 2^bits in magnitude

    explicit Scaled(const std::array<double, n>& v) {
        int largest = std::numeric_limits<int>::min();
        least = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < n; ++i) {
            values[i] = decompose(v[i]);
            if (values[i].mantissa == 0)
                continue;
            const auto magnitude = static_cast<std::uint64_t>(std::abs(values[i].mantissa));
            least = std::min(least, values[i].exponent);
            largest =
                std::max(largest, values[i].exponent + static_cast<int>(std::bit_width(magnitude)));
        }
        bits = largest > least ? largest - least : 0;
    }

    template <typename Int>
    [[nodiscard]] Int get(std::size_t i) const {
        const Binary& v = values[i];
        if (v.mantissa == 0)
            return Int(0);
        Int r = v.mantissa < 0 ? Int(-v.mantissa) : Int(v.mantissa);
        r <<= v.exponent - least;
        return v.mantissa < 0 ? Int(-r) : r;
    }
};

} // namespace abut
