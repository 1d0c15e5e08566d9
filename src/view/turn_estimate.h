#pragma once

#include <abut/types.h>

#include "core/stop_watch.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

/// Estimates how fast a viewing direction turns, from the directions of the last frames.
class TurnEstimate {
public:
    /// Returns axis times radians a second, from the direction of this frame and the time since the
    /// last call.
    Vec3 update(const Vec3& direction) {
        const double seconds = watch_.lap();
        const Vec3 now = normalized_or_zero(direction);
        const Vec3 axis = cross(before_, now);
        const double angle = std::atan2(length(axis), dot(before_, now));
        before_ = now;
        std::rotate(turns_.begin(), turns_.begin() + 1, turns_.end());
        turns_.back() =
            seconds > 0 && seconds < kPause ? (angle / seconds) * normalized_or_zero(axis) : Vec3{};
        // The median of three frames ignores a single jump or a late frame.
        const auto& [a, b, c] = turns_;
        return {median(a.x, b.x, c.x), median(a.y, b.y, c.y), median(a.z, b.z, c.z)};
    }

private:
    static constexpr double kPause = 1; ///< seconds after which the last direction tells nothing

    static double median(double a, double b, double c) {
        return std::max(std::min(a, b), std::min(std::max(a, b), c));
    }

    Vec3 before_;
    std::array<Vec3, 3> turns_{};
    StopWatch watch_;
};

} // namespace abut
