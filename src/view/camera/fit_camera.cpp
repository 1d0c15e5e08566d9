#include "view/camera/fit_camera.h"

#include "math/vector.h"
#include "view/camera/camera_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace abut {

Vec3 up_vector(UpAxis up) {
    return {up == UpAxis::x ? 1.0 : 0, up == UpAxis::y ? 1.0 : 0, up == UpAxis::z ? 1.0 : 0};
}

Vec3 front_direction(UpAxis up) {
    return up == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
}

Vec3 corner_of(const Box3& box, int i) {
    return {(i & 1) != 0 ? box.upper.x : box.lower.x, (i & 2) != 0 ? box.upper.y : box.lower.y,
            (i & 4) != 0 ? box.upper.z : box.lower.z};
}

Camera fit_boxes(std::span<const Box3> boxes, const ViewDirection& direction, const Camera& lens) {
    constexpr double kMargin = 0.94; // of the picture that the boxes fill
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    Camera camera = lens;
    camera.forward = direction.towards;
    camera.up = direction.up;
    camera.eye = {};
    const CameraFrame frame(camera);
    // A point (x, y, z) along right, up, forward is in the picture of an eye at (p, q, r) if
    // |x - p| <= s (z - r): p - s r >= x - s z and p + s r <= x + s z; y likewise.
    std::array<double, 2> most{-kInfinite, -kInfinite}, least{kInfinite, kInfinite};
    const std::array<double, 2> slope{kMargin * frame.slope_x, kMargin * frame.slope_y};
    const std::array<Vec3, 2> across{frame.right, frame.up};
    double size = 0;
    for (const Box3& box : boxes)
        for (int i = 0; i < (is_empty(box) ? 0 : 8); ++i) {
            const Vec3 corner = corner_of(box, i);
            const double z = dot(frame.forward, corner);
            size = std::max(size, max_abs(corner));
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const double x = dot(across.at(axis), corner);
                most.at(axis) = std::max(most.at(axis), x - slope.at(axis) * z);
                least.at(axis) = std::min(least.at(axis), x + slope.at(axis) * z);
            }
        }
    if (most[0] == -kInfinite)
        return camera;
    double depth = kInfinite;
    for (std::size_t axis = 0; axis < 2; ++axis)
        depth = std::min(depth, (least.at(axis) - most.at(axis)) / (2 * slope.at(axis)));
    depth -= 1e-9 * size + 1e-12; // a point is seen from a little away
    camera.eye = 0.5 * (least[0] + most[0]) * frame.right + 0.5 * (least[1] + most[1]) * frame.up +
                 depth * frame.forward;
    return camera;
}

std::vector<ViewDirection> directions_around(UpAxis up_axis) {
    const Vec3 up = up_vector(up_axis), front = front_direction(up_axis);
    const Vec3 right = cross(front, up);
    std::vector<ViewDirection> directions;
    for (const double height : {0.45, 0.85, 0.1, -0.4})
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5) / 12;
            const Vec3 flat = std::cos(angle) * front + std::sin(angle) * right;
            directions.push_back({normalized_or_zero(flat + -height * up), up});
        }
    return directions;
}

} // namespace abut
