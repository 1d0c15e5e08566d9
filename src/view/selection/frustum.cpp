#include "view/selection/frustum.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

Frustum::Frustum(const CameraFrame& frame, double near, double far, const Vec3& origin,
                 double widening) {
    const Vec3 eye = frame.eye - origin;
    const double x = widening * frame.slope_x, y = widening * frame.slope_y;
    const auto plane = [&](const Vec3& normal, double beyond) {
        const Vec3 unit = normalized_or_zero(normal);
        return Plane{unit, dot(unit, eye) + beyond};
    };
    planes_ = {plane(x * frame.forward + frame.right, 0),
               plane(x * frame.forward - frame.right, 0),
               plane(y * frame.forward + frame.up, 0),
               plane(y * frame.forward - frame.up, 0),
               plane(frame.forward, near),
               plane(-frame.forward, -far)};
    size_ = 3 * max_abs(frame.eye) + 3 * max_abs(origin) + far;
}

std::uint32_t Frustum::cut(const std::array<float, 3>& lower, const std::array<float, 3>& upper,
                           std::uint32_t planes) const {
    double size = size_;
    for (std::size_t axis = 0; axis < 3; ++axis)
        size += std::max(std::abs(double{lower.at(axis)}), std::abs(double{upper.at(axis)}));
    const double error = 0x1p-48 * size;
    std::uint32_t cutting = 0;
    for (std::uint32_t i = 0; i < kPlanes; ++i) {
        if ((planes & (1U << i)) == 0)
            continue;
        const auto& [normal, offset] = planes_[i];
        // The corners that are farthest along the normal, and farthest against it.
        double most = 0, least = 0;
        const std::array<double, 3> n{normal.x, normal.y, normal.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double a = n[axis] * lower[axis], b = n[axis] * upper[axis];
            most += std::max(a, b);
            least += std::min(a, b);
        }
        if (most < offset - error)
            return kOutside;
        if (least < offset + error)
            cutting |= 1U << i;
    }
    return cutting;
}

} // namespace abut
