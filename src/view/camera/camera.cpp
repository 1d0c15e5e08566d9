#include <abut/camera.h>

#include "core/arguments.h"
#include "math/vector.h"
#include "mesh/topology.h"
#include "view/camera/camera_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>

namespace abut {

namespace {

/// Sine of the least angle between the viewing direction and the upward direction.
constexpr double kLeastSine = 1e-9;

/// A unit vector, also of a vector whose squared length is beyond the range of doubles.
Vec3 unit_of(const Vec3& v) {
    const double size = max_abs(v);
    return size > 0 ? normalized_or_zero(Vec3{v.x / size, v.y / size, v.z / size}) : Vec3{};
}

void require_lens(const Camera& camera) {
    require(camera.field_of_view > 0 && camera.field_of_view < std::numbers::pi,
            "field of view of the camera must be between 0 and pi");
    require(camera.width >= 1 && camera.height >= 1,
            "picture of the camera must be at least one pixel wide and high");
    require(camera.near > 0 && camera.near < camera.far && std::isfinite(camera.far),
            "clipping distances of the camera must be 0 < near < far, and finite");
}

double slope_y_of(const Camera& camera) {
    return std::tan(0.5 * camera.field_of_view);
}

} // namespace

CameraFrame::CameraFrame(const Camera& camera) : eye(camera.eye) {
    require_lens(camera);
    require(is_finite(eye) && max_abs(eye) <= kLargestCoordinate,
            "eye of the camera has a coordinate that is not finite or beyond 1e18");
    require(is_finite(camera.forward) && camera.forward != Vec3{},
            "viewing direction of the camera must be finite and not zero");
    require(is_finite(camera.up) && camera.up != Vec3{},
            "upward direction of the camera must be finite and not zero");
    forward = unit_of(camera.forward);
    right = cross(forward, unit_of(camera.up));
    require(length(right) > kLeastSine,
            "viewing direction and upward direction of the camera are parallel");
    right = normalized_or_zero(right);
    up = cross(right, forward);
    slope_y = slope_y_of(camera);
    slope_x = slope_y * camera.width / camera.height;
}

std::array<float, 16> clip_from_world(const Camera& camera, const Vec3& origin) {
    const CameraFrame frame(camera);
    require(is_finite(origin), "origin has a coordinate that is not finite");
    const Vec3 eye = frame.eye - origin;
    const double depth = camera.near - camera.far;
    const double scale = (camera.far + camera.near) / depth;
    const double offset = 2 * camera.far * camera.near / depth;
    // Each row of the matrix is an axis of the camera, scaled, and its product with the eye.
    const Vec3 back = -frame.forward;
    const std::array<Vec3, 4> axes{(1 / frame.slope_x) * frame.right,
                                   (1 / frame.slope_y) * frame.up, scale * back, frame.forward};
    std::array<float, 16> matrix{};
    for (std::size_t row = 0; row < 4; ++row) {
        const Vec3& axis = axes.at(row);
        const double last = (row == 2 ? offset : 0) - dot(axis, eye);
        std::size_t column = 0;
        for (const double value : {axis.x, axis.y, axis.z, last})
            matrix.at(4 * column++ + row) = static_cast<float>(value);
    }
    return matrix;
}

Ray ray_through(const Camera& camera, double x, double y) {
    const CameraFrame frame(camera);
    require(std::isfinite(x) && std::isfinite(y), "pixel is not finite");
    const double right = frame.slope_x * (2 * x / camera.width - 1);
    const double up = frame.slope_y * (1 - 2 * y / camera.height);
    return {frame.eye, unit_of(frame.forward + right * frame.right + up * frame.up)};
}

double length_of_pixel(const Camera& camera) {
    require_lens(camera);
    return 2 * slope_y_of(camera) / camera.height;
}

Camera look_at_box(const Box3& box, const Vec3& towards, const Vec3& up, const Camera& lens) {
    require(!is_empty(box) && is_finite(box.lower) && is_finite(box.upper),
            "box to look at must be finite and not empty");
    Camera camera = lens;
    camera.eye = 0.5 * box.lower + 0.5 * box.upper;
    camera.forward = towards;
    camera.up = up;
    // From straight above or below, any direction may be up in the picture.
    if (is_finite(towards) && is_finite(up) && up != Vec3{} &&
        length(cross(unit_of(towards), unit_of(up))) <= kLeastSine)
        camera.up = perpendicular(unit_of(towards));
    const CameraFrame frame(camera);
    constexpr double kMargin = 1.05;
    double back = 0, behind = 0; // of the eye; of the farthest corner, behind the middle
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 at{(corner & 1U) != 0 ? box.upper.x : box.lower.x,
                      (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                      (corner & 4U) != 0 ? box.upper.z : box.lower.z};
        const Vec3 d = at - frame.eye;
        const double ahead = dot(d, frame.forward);
        const double least = std::max({std::abs(dot(d, frame.right)) / frame.slope_x,
                                       std::abs(dot(d, frame.up)) / frame.slope_y, camera.near});
        back = std::max(back, kMargin * least - ahead);
        behind = std::max(behind, ahead);
    }
    camera.eye = frame.eye - back * frame.forward;
    camera.far = std::max(camera.far, kMargin * (back + behind));
    return camera;
}

} // namespace abut
