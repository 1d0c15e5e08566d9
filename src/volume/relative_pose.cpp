#include "volume/relative_pose.h"

#include "math/rounding.h"
#include "volume/aabb.h"

#include <cmath>

namespace abut {

RelativePose make_relative_pose(const Transform& to_from, double reach_to, double reach_from,
                                double slack) {
    constexpr double kLargest = 0x1p60, kLeast = 0x1p-40;
    RelativePose pose;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            pose.linear[row][column] = to_float(to_from.m[3 * column + row]);
        pose.translation[row] = to_float(to_from.m[9 + row]);
    }
    const auto [least, most] = stretch_of(to_from);
    const double size =
        most * reach_from + length({to_from.m[9], to_from.m[10], to_from.m[11]}) + reach_to;
    pose.most_stretch = round_up(most * (1 + 4 * 0x1p-24));
    pose.margin = round_up(64 * 0x1p-24 * size + slack);
    // Comparisons with NaN are false.
    pose.valid = size < kLargest && most < kLargest && slack < kLargest && least > kLeast * most;
    return pose;
}

} // namespace abut
