#pragma once

#include <abut/types.h>

#include "math/rounding.h"
#include "walk/box_tree.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

/// The positions of the next seconds if the velocity stays constant, in the frame of the boxes. It
/// gives each box a key, by which parts are read ahead.
///
/// The key of a box is the minimum, over points of the path, of the distance from the point plus a
/// share of the path up to the point. Boxes beside the current position therefore come before boxes
/// far ahead.
class PredictedPath {
public:
    PredictedPath() = default;
    PredictedPath(const Vec3& position, const Vec3& velocity, double seconds) {
        const double way = length(velocity) * seconds;
        points_ = way > 0 ? kMostPoints : 1;
        for (std::size_t i = 0; i < points_; ++i) {
            const double share =
                static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(points_ - 1, 1));
            const Vec3 at = position + share * seconds * velocity;
            x_[i] = to_float(at.x), y_[i] = to_float(at.y);
            z_[i] = to_float(at.z);
            cost_[i] = to_float(kShareOfWay * share * way);
        }
    }

    [[nodiscard]] LaneKeys operator()(const BoxNode& block) const {
        LaneKeys keys;
        keys.fill(std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < points_; ++i)
            for (std::size_t lane = 0; lane < BoxNode::kWidth; ++lane)
                keys[lane] = std::min(keys[lane],
                                      cost_[i] + std::sqrt(square_of_gap(block, 0, lane, x_[i]) +
                                                           square_of_gap(block, 1, lane, y_[i]) +
                                                           square_of_gap(block, 2, lane, z_[i])));
        return keys;
    }
    /// Returns the largest distance between points of both paths at the same time. The paths are
    /// straight, so it occurs at one of their ends.
    [[nodiscard]] float difference(const PredictedPath& other) const {
        if (points_ == 0 || other.points_ == 0)
            return std::numeric_limits<float>::infinity();
        const auto apart = [&](std::size_t i, std::size_t k) {
            return std::hypot(x_[i] - other.x_[k], y_[i] - other.y_[k], z_[i] - other.z_[k]);
        };
        return std::max(apart(0, 0), apart(points_ - 1, other.points_ - 1));
    }

private:
    static constexpr std::size_t kMostPoints = 16;
    static constexpr double kShareOfWay = 0.125;

    static float square(float v) { return v * v; }
    static float square_of_gap(const BoxNode& block, std::size_t axis, std::size_t lane, float at) {
        return square(
            std::max(0.0F, std::max(block.lower[axis][lane] - at, at - block.upper[axis][lane])));
    }
    std::size_t points_ = 0;
    std::array<float, kMostPoints> x_{}, y_{}, z_{}, cost_{};
};

} // namespace abut
