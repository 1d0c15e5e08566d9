#pragma once

#include <abut/types.h>

#include "math/rounding.h"
#include "math/vector.h"
#include "volume/aabb.h"
#include "walk/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace abut {

/// A box that moves in a straight line: at t in [begin, end] it is `box` + t velocity.
struct BoxMotion {
    Aabb box;
    Vec3 velocity;
    double begin = 0, end = 1; ///< either may be infinite
};

/// Computes, for a batch of boxes, lower bounds of the first t at which one of some moving boxes
/// meets them; infinite for boxes that are not met. A ray is a box without extent.
struct EntryTimes {
    std::span<const BoxMotion> moving;

    LaneKeys operator()(const BoxNode& block) const {
        LaneKeys keys{};
        keys.fill(std::numeric_limits<float>::infinity());
        for (const BoxMotion& one : moving)
            take(one, block, keys);
        return keys;
    }

private:
    /// Far above the rounding of the quotients below, and of the velocity, relative to t.
    static constexpr double kRounding = 0x1p-40;
    using Lanes = std::array<double, BoxNode::kWidth>;

    static void take(const BoxMotion& one, const BoxNode& block, LaneKeys& keys) {
        Lanes enter{}, leave{};
        enter.fill(one.begin), leave.fill(one.end);
        for (int axis = 0; axis < 3; ++axis)
            clip(one, block, axis, enter, leave);
        for (std::size_t lane = 0; lane < BoxNode::kWidth; ++lane) {
            const bool is_met =
                enter[lane] <= leave[lane] && block.lower[0][lane] <= block.upper[0][lane];
            if (is_met)
                keys[lane] =
                    std::min(keys[lane], to_float(enter[lane] - 0x1p-20 * std::abs(enter[lane])));
        }
    }

    static void clip(const BoxMotion& one, const BoxNode& block, int axis, Lanes& enter,
                     Lanes& leave) {
        const auto k = static_cast<std::size_t>(axis);
        const double speed = component(one.velocity, axis);
        const double low = one.box.lower[k], high = one.box.upper[k];
        for (std::size_t lane = 0; lane < BoxNode::kWidth; ++lane) {
            const double below = block.lower[k][lane] - high, above = block.upper[k][lane] - low;
            if (speed == 0) {
                if (below > 0 || above < 0)
                    leave[lane] = -std::numeric_limits<double>::infinity();
                continue;
            }
            const double first = speed > 0 ? below / speed : above / speed,
                         last = speed > 0 ? above / speed : below / speed;
            enter[lane] = std::max(enter[lane], first - kRounding * std::abs(first));
            leave[lane] = std::min(leave[lane], last + kRounding * std::abs(last));
        }
    }
};

} // namespace abut
