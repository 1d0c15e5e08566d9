#pragma once

#include <bit>
#include <concepts>
#include <iterator>

namespace abut {

/// The set bits of a word, lowest first: `for (const std::size_t lane : SetBits(lanes))`. An index
/// is an int, as of std::countr_zero. The loop chooses the type that its body needs: converted once,
/// it costs nothing.
template <std::unsigned_integral Word>
class SetBits {
public:
    class Iterator {
    public:
        constexpr explicit Iterator(Word left) : left_(left) {}
        constexpr int operator*() const { return std::countr_zero(left_); }
        constexpr Iterator& operator++() {
            left_ &= left_ - 1;
            return *this;
        }
        constexpr bool operator==(std::default_sentinel_t) const { return left_ == 0; }

    private:
        Word left_;
    };

    constexpr explicit SetBits(Word bits) : bits_(bits) {}
    [[nodiscard]] constexpr Iterator begin() const { return Iterator(bits_); }
    [[nodiscard]] constexpr std::default_sentinel_t end() const { return {}; }

private:
    Word bits_;
};

} // namespace abut
