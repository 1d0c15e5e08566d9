#pragma once

#include <abut/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut {

/// Numbered points in a grid of cubes whose edge is the reach.
class PointGrid {
public:
    /// In          reach: positive.
    explicit PointGrid(double reach) : reach_(reach) {}

    void add(std::uint32_t number, const Vec3& point) {
        cells_[{index(point.x), index(point.y), index(point.z)}].push_back(number);
    }

    /// In          point: as it was added.
    void remove(std::uint32_t number, const Vec3& point) {
        std::erase(cells_.at({index(point.x), index(point.y), index(point.z)}), number);
    }

    /// Calls take(numbers) with the points of each cube that the box around a point meets. These
    /// are at least the points whose distance, as computed, is within the reach.
    template <typename Take>
    void for_each_cell(const Vec3& point, const Take& take) const {
        const Range x = around(point.x), y = around(point.y), z = around(point.z);
        for (std::int64_t i = x.first; i <= x.last; ++i)
            for (std::int64_t j = y.first; j <= y.last; ++j)
                for (std::int64_t k = z.first; k <= z.last; ++k)
                    if (const auto found = cells_.find({i, j, k}); found != cells_.end())
                        take(found->second);
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t hash = 0;
            for (const std::int64_t c : cell)
                hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U;
            return static_cast<std::size_t>(hash ^ hash >> 32);
        }
    };
    struct Range {
        std::int64_t first, last;
    };

    [[nodiscard]] std::int64_t index(double v) const {
        constexpr double kFar = 1e15; // keeps the conversion defined for any point
        const double cell = std::floor(v / reach_);
        if (!(cell > -kFar)) // also not a number
            return -static_cast<std::int64_t>(kFar);
        return static_cast<std::int64_t>(std::min(cell, kFar));
    }
    /// The reach is enlarged by more than a computed distance can be too small. Sums and quotients
    /// are rounded monotonically, so that no point within reach is missed. It lies at most two cubes
    /// away, which bounds the range where the sums overflow.
    [[nodiscard]] Range around(double v) const {
        constexpr double kSlack = 1 + 1e-12;
        const std::int64_t middle = index(v);
        return {std::max(index(v - kSlack * reach_), middle - 2),
                std::min(index(v + kSlack * reach_), middle + 2)};
    }

    double reach_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

} // namespace abut
