#pragma once

#include "volume/aabb.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// Boxes of something whose points move in straight lines, at both ends of their motion. Two of them
/// meet at no time if along one axis one is below the other at the start and at the end.
struct MovingBox {
    Aabb start, end;

    void merge(const MovingBox& other) {
        start.merge(other.start);
        end.merge(other.end);
    }
    /// What it stays within.
    [[nodiscard]] Aabb swept() const {
        Aabb box = start;
        box.merge(end);
        return box;
    }
};

/// Some things in moving boxes: their numbers, and the boxes in rows, one for each bound.
/// rows[r * count + k] is box k's lower bound on axis r, or its upper bound on axis r - 3, at the
/// start; rows 6 to 11 are those at the end. May be empty.
///
/// Kernels read up to kPadding floats beyond the last row.
struct MovingBoxRun {
    static constexpr std::uint32_t kMost = 31; ///< boxes in a run
    static constexpr std::size_t kRows = 12;
    static constexpr std::size_t kPadding = 8;
    /// Of the bounds at the end.
    static constexpr std::size_t kEnd = 6;

    const float* rows = nullptr;
    const std::uint32_t* ids = nullptr;
    std::uint32_t count = 0;

    /// A bit for each.
    [[nodiscard]] std::uint32_t all() const { return (1U << count) - 1; }
};

/// One of a run.
struct MovingBoxRef {
    MovingBoxRun run;
    std::uint32_t place = 0;
};

/// Which boxes of a run may meet which of another.
struct RunOverlaps {
    MovingBoxRun a, b;
    std::uint32_t rows = 0; ///< the boxes of a that may meet something: a bit each
    /// Of each of these the boxes of b: a bit each.
    std::array<std::uint32_t, MovingBoxRun::kMost> masks;

    /// Of a run with itself: leaves each pair once, and none with itself.
    void keep_once() {
        for_each_row([&](std::uint32_t k) { masks[k] &= ~0U << k << 1; });
    }
    [[nodiscard]] std::uint32_t count() const {
        std::uint32_t pairs = 0;
        for_each_row(
            [&](std::uint32_t k) { pairs += static_cast<std::uint32_t>(std::popcount(masks[k])); });
        return pairs;
    }
    /// Calls visit(id of a, id of b).
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for_each_row([&](std::uint32_t k) {
            for (std::uint32_t mask = masks[k]; mask != 0; mask &= mask - 1)
                visit(a.ids[k], b.ids[std::countr_zero(mask)]);
        });
    }

private:
    template <typename Visit>
    void for_each_row(const Visit& visit) const {
        for (std::uint32_t left = rows; left != 0; left &= left - 1)
            visit(static_cast<std::uint32_t>(std::countr_zero(left)));
    }
};

/// Fills in rows and masks, of boxes that may come within a margin of each other.
///
/// In          a box around all that the runs a hold, one around all that the runs b hold.
/// Accuracy    certified: no bit is missing for boxes that come so near at some time.
/// Cost        some 30 instructions for a box against eight.
void find_overlaps(std::span<RunOverlaps> overlaps, const MovingBoxRef& around_b, float margin);

} // namespace abut
