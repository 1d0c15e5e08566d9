#include "volume/support_bound.h"

#include "volume/aabb.h"

#include <limits>

namespace abut {

SupportBound::SupportBound(std::span<const Vec3> points) {
    Box3 box;
    for (const Vec3& p : points)
        extend(box, p);
    constexpr double kNothing = -std::numeric_limits<double>::infinity();
    height_.fill(-std::numeric_limits<float>::infinity());
    if (points.empty())
        return;
    middle_ = 0.5 * box.lower + 0.5 * box.upper;
    // Half the normals: each point counts for both ends.
    std::array<double, kMiddle> high{}, low{};
    high.fill(kNothing);
    low.fill(kNothing);
    for (const Vec3& point : points) {
        const Vec3 p = point - middle_;
        const std::array<double, kMiddle> heights{p.x,
                                                  p.y - p.x,
                                                  p.y,
                                                  p.y + p.x,
                                                  p.z - p.x - p.y,
                                                  p.z - p.y,
                                                  p.z - p.y + p.x,
                                                  p.z - p.x,
                                                  p.z,
                                                  p.z + p.x,
                                                  p.z + p.y - p.x,
                                                  p.z + p.y,
                                                  p.z + p.y + p.x};
        for (std::size_t i = 0; i < heights.size(); ++i) {
            high[i] = std::max(high[i], heights[i]);
            low[i] = std::max(low[i], -heights[i]);
        }
    }
    for (std::size_t i = 0; i < high.size(); ++i) {
        height_[kMiddle + 1 + i] = round_up(high[i]);
        height_[kMiddle - 1 - i] = round_up(low[i]);
    }
    const Vec3 half = max(box.upper - middle_, middle_ - box.lower);
    size_ = half.x + half.y + half.z;
}

} // namespace abut
