#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace abut {

/// For each position, the index of the first position equal to it. Positions are equal if all bits
/// are, except that -0 equals 0.
///
/// In          fewer than 2^32 - 1 positions, with members x, y, z of type float or double; any
///             values.
/// Cost        O(n) expected: one pass over a flat table with linear probing, 8 to 16 bytes for
///             each position.
template <typename Position>
std::vector<std::uint32_t> first_equal_positions(std::span<Position> positions);

/// Removes all but the first of equal positions and keeps their order. Returns the new index of
/// each former position. In and Cost as first_equal_positions.
template <typename Position>
std::vector<std::uint32_t> join_equal_positions(std::vector<Position>& positions);

namespace detail {

/// The bits of a coordinate, where -0 counts as 0.
template <typename Real>
auto coordinate_bits(Real value) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Bits>(value == 0 ? Real{0} : value);
}

template <typename Position>
bool is_equal_position(const Position& p, const Position& q) {
    return coordinate_bits(p.x) == coordinate_bits(q.x) &&
           coordinate_bits(p.y) == coordinate_bits(q.y) &&
           coordinate_bits(p.z) == coordinate_bits(q.z);
}

/// Hash of a position. Coordinates on a grid differ only in a few high bits. The product spreads
/// differences upwards, and the shift brings them back down.
template <typename Position>
std::uint64_t position_hash(const Position& p) {
    constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
    std::uint64_t hash = 0;
    for (const std::uint64_t bits :
         {std::uint64_t{coordinate_bits(p.x)}, std::uint64_t{coordinate_bits(p.y)},
          std::uint64_t{coordinate_bits(p.z)}}) {
        hash = (hash ^ bits) * kOdd;
        hash ^= hash >> 32;
    }
    return hash * kOdd;
}

} // namespace detail

template <typename Position>
std::vector<std::uint32_t> first_equal_positions(std::span<Position> positions) {
    constexpr std::uint32_t kFree = 0xffffffff;
    // At least twice as many slots as positions, so that probes stay short.
    const int index_bits = std::bit_width(positions.size()) + 1;
    const std::size_t last = (std::size_t{1} << index_bits) - 1;
    std::vector<std::uint32_t> table(last + 1, kFree);
    std::vector<std::uint32_t> first(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        std::size_t place = detail::position_hash(positions[i]) >> (64 - index_bits);
        while (table[place] != kFree &&
               !detail::is_equal_position(positions[table[place]], positions[i]))
            place = (place + 1) & last;
        if (table[place] == kFree)
            table[place] = i;
        first[i] = table[place];
    }
    return first;
}

template <typename Position>
std::vector<std::uint32_t> join_equal_positions(std::vector<Position>& positions) {
    std::vector<std::uint32_t> number_of = first_equal_positions(std::span(positions));
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < number_of.size(); ++i) {
        const std::uint32_t first = number_of[i];
        if (first < i) {
            number_of[i] = number_of[first];
            continue;
        }
        positions[count] = positions[i];
        number_of[i] = count++;
    }
    positions.resize(count);
    return number_of;
}

} // namespace abut
