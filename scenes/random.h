#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut::scenes {

/// Mixes the bits of x. It is a bijection, so distinct numbers stay distinct.
///
/// Source      SplitMix64 [Steele, Lea, Flood 2014].
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// Random numbers that are the same on every machine; those of the C++ library's distributions are
/// not. The order in which a call's arguments are evaluated is not fixed either: draw one number
/// per statement, or draw within braces.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15U); }
    /// A number in [0, n). In: n > 0.
    int below(int n) {
        return static_cast<int>(((next() >> 32) * static_cast<std::uint64_t>(n)) >> 32);
    }
    /// A number in [low, high], both ends included.
    int between(int low, int high) { return low + below(high - low + 1); }
    /// A number in [low, high), a multiple of 1/1024.
    double uniform(double low, double high) {
        const auto first = static_cast<std::int64_t>(low * 1024);
        const auto last = static_cast<std::int64_t>(high * 1024);
        const auto span = static_cast<std::uint64_t>(last > first ? last - first : 1);
        return static_cast<double>(first + static_cast<std::int64_t>(next() % span)) / 1024;
    }
    bool chance(double p) { return static_cast<double>(next() >> 11) * 0x1p-53 < p; }
    template <class T, std::size_t N>
    const T& pick(const std::array<T, N>& values) {
        return values[static_cast<std::size_t>(below(static_cast<int>(N)))];
    }

private:
    std::uint64_t state_;
};

} // namespace abut::scenes
