#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/box_node.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace abut {

/// A box as SIMD compares it: each corner in a register, with an unused lane. The bounds of a box
/// that takes no part are not numbers, so that it meets nothing and lies in nothing.
struct alignas(64) BoxLine {
    double lower[4]{}, upper[4]{};

    void set(const Box3& box) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        const bool takes = takes_part(box);
        lower[0] = takes ? box.lower.x : kNone, upper[0] = takes ? box.upper.x : kNone;
        lower[1] = takes ? box.lower.y : kNone, upper[1] = takes ? box.upper.y : kNone;
        lower[2] = takes ? box.lower.z : kNone, upper[2] = takes ? box.upper.z : kNone;
    }
    [[nodiscard]] bool takes_any_part() const { return lower[0] == lower[0]; }
};

/// Returns whether a box takes part and lies in another one. It compares all bounds, because which
/// one lies beyond cannot be predicted.
inline bool lies_in(const Box3& box, const BoxLine& other) {
    const auto along = [](double lower, double upper, double from, double to) {
        return static_cast<unsigned>(from <= lower) & static_cast<unsigned>(upper <= to) &
               static_cast<unsigned>(lower <= upper);
    };
    return (along(box.lower.x, box.upper.x, other.lower[0], other.upper[0]) &
            along(box.lower.y, box.upper.y, other.lower[1], other.upper[1]) &
            along(box.lower.z, box.upper.z, other.lower[2], other.upper[2])) != 0;
}

/// Tests whether the boxes of each pair meet, and compares the answers with those of the last step.
///
/// In/out      `meets`: the answer for each pair, 0 or 1.
/// Out         `flipped`: the places of the pairs whose answer has changed, in order; it has room
///             for all pairs. Returns their number.
/// Accuracy    exact.
std::size_t find_flipped(std::span<const BoxLine> boxes, std::span<const IndexPair> pairs,
                         std::span<std::uint8_t> meets, std::span<std::uint32_t> flipped);

} // namespace abut
