#pragma once

#include "core/set_bits.h"
#include "volume/aabb.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// The two ends of a motion.
enum class StepEnd : std::uint8_t { start, end };
inline constexpr std::array kStepEnds{StepEnd::start, StepEnd::end};

/// Boxes around something whose points move in straight lines, at both ends of the motion. Two
/// moving boxes never meet if, along one axis, one lies below the other at both ends.
struct MovingBox {
    Aabb start, end;

    [[nodiscard]] const Aabb& at(StepEnd step_end) const {
        return step_end == StepEnd::start ? start : end;
    }
    /// The box that encloses the whole motion.
    [[nodiscard]] Aabb swept() const {
        Aabb box = start;
        box.merge(end);
        return box;
    }
};

/// A run of moving boxes with ids. The boxes are stored in rows, one for each bound. At the start
/// of the motion, rows[r * count + k] is box k's lower bound on axis r (r < 3) or its upper bound
/// on axis r - 3. Rows 6 to 11 are the same bounds at the end. May be empty.
///
/// Kernels read up to kPadding floats beyond the last row.
struct MovingBoxRun {
    static constexpr std::uint32_t kMost = 12; ///< maximum number of boxes in a run
    static constexpr std::size_t kRows = 12;
    static constexpr std::size_t kPadding = 8;
    /// First row of the bounds at the end.
    static constexpr std::size_t kEnd = 6;

    const float* rows = nullptr;
    const std::uint32_t* ids = nullptr;
    std::uint32_t count = 0;

    /// A mask with a bit set for each box.
    [[nodiscard]] std::uint32_t all() const { return (1U << count) - 1; }
};

/// Index of the first bound of box k at one end, in rows of `count` floats.
inline std::size_t first_bound(StepEnd end, std::size_t count, std::size_t k) {
    return (end == StepEnd::start ? 0 : MovingBoxRun::kEnd) * count + k;
}
/// Writes the six bounds of a box, `count` floats apart.
inline void set_bounds(float* bound, std::size_t count, const Aabb& box) {
    for (const auto& side : {box.lower, box.upper})
        for (const float value : side) {
            *bound = value;
            bound += count;
        }
}
inline Aabb bounds_from(const float* bound, std::size_t count) {
    Aabb box;
    for (auto* side : {&box.lower, &box.upper})
        for (float& value : *side) {
            value = *bound;
            bound += count;
        }
    return box;
}

/// One box of a run.
struct MovingBoxRef {
    MovingBoxRun run;
    std::uint32_t place = 0;
};

/// Which boxes of run a may meet which boxes of run b: a matrix of bits in tiles of eight by eight.
/// Bit 8 k + i of a tile stands for the tile's box k of a and box i of b.
struct RunOverlaps {
    static constexpr std::uint32_t kTile = 8;
    static constexpr std::uint32_t kTiles = (MovingBoxRun::kMost + kTile - 1) / kTile; ///< along
                                                                                       ///< one side

    MovingBoxRun a, b;
    std::array<std::uint64_t, std::size_t{kTiles} * kTiles>
        tiles{}; ///< row by row, those of a's first boxes first

    [[nodiscard]] static std::uint32_t tiles_of(const MovingBoxRun& run) {
        return (run.count + kTile - 1) / kTile;
    }

    /// For a run against itself: keeps each pair once, and no box with itself.
    void keep_once() {
        // Bits i of row k with i > k.
        constexpr std::uint64_t kAbove = 0x0080c0e0f0f8fcfe;
        for_each_tile([&](std::uint32_t i, std::uint32_t k, std::uint64_t& tile) {
            tile &= i < k ? ~std::uint64_t{0} : i == k ? kAbove : 0;
        });
    }
    [[nodiscard]] std::uint32_t count() {
        std::uint32_t pairs = 0;
        for_each_tile([&](std::uint32_t, std::uint32_t, std::uint64_t tile) {
            pairs += static_cast<std::uint32_t>(std::popcount(tile));
        });
        return pairs;
    }
    /// Calls visit(id of a, id of b).
    template <typename Visit>
    void for_each(const Visit& visit) {
        for_each_tile([&](std::uint32_t i, std::uint32_t k, std::uint64_t tile) {
            const std::uint32_t* ids_a = a.ids + std::size_t{i} * kTile;
            const std::uint32_t* ids_b = b.ids + std::size_t{k} * kTile;
            for (const std::uint32_t bit : SetBits(tile))
                visit(ids_a[bit / kTile], ids_b[bit % kTile]);
        });
    }

private:
    template <typename Visit>
    void for_each_tile(const Visit& visit) {
        std::uint64_t* tile = tiles.data();
        for (std::uint32_t i = 0; i < tiles_of(a); ++i)
            for (std::uint32_t k = 0; k < tiles_of(b); ++k)
                visit(i, k, *tile++);
    }
};

/// Fills in the tiles with the pairs of boxes that may come within a margin of each other until a
/// time `until`, which counts from 0 at the start of the motion to 1 at its end.
///
/// Accuracy    conservative: every pair that comes within the margin until that time has its bit.
/// Cost        about 30 instructions for a box against eight; 40 if `until` is below 1.
void find_overlaps(std::span<RunOverlaps> overlaps, float margin, float until = 1);
/// As find_overlaps, but compares the boxes at one end of the motion only.
///
/// Accuracy    conservative: every pair that is within the margin at that end has its bit.
/// Cost        half of that of find_overlaps.
void find_overlaps_at(std::span<RunOverlaps> overlaps, float margin, StepEnd end);

} // namespace abut
