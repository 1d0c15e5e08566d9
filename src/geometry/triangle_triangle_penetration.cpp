#include "geometry/triangle_triangle_penetration.h"

#include <algorithm>
#include <limits>

namespace abut {

TriangleSeparation triangle_triangle_penetration(const Triangle& a, const Triangle& b) {
    TriangleSeparation best{std::numeric_limits<double>::infinity(), {}};
    const Vec3 origin = a[0];
    const auto try_axis = [&](const Vec3& axis) {
        const Vec3 n = normalized_or_zero(axis);
        if (n == Vec3{})
            return;
        const auto project = [&](const Triangle& t) {
            return std::minmax(
                {dot(n, t[0] - origin), dot(n, t[1] - origin), dot(n, t[2] - origin)});
        };
        const auto [a_low, a_high] = project(a);
        const auto [b_low, b_high] = project(b);
        // b moves up past a, or down past it.
        const double up = a_high - b_low, down = b_high - a_low;
        const double depth = std::max(0.0, std::min(up, down));
        if (depth < best.depth)
            best = {depth, up <= down ? n : -n};
    };
    try_axis(cross(a[1] - a[0], a[2] - a[0]));
    try_axis(cross(b[1] - b[0], b[2] - b[0]));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            try_axis(cross(a[(i + 1) % 3] - a[i], b[(j + 1) % 3] - b[j]));
    if (best.depth == std::numeric_limits<double>::infinity())
        return {0, {}};
    return best;
}

} // namespace abut
