#include "render/drawn_camera.h"

#include <abut/error.h>
#include <abut/renderer.h>

#include "math/rounding.h"
#include "math/vector.h"

#include <cmath>
#include <numbers>

namespace abut {

namespace {

void require_valid(const Camera& camera) {
    const bool has_lens = camera.field_of_view > 0 && camera.field_of_view < std::numbers::pi &&
                          camera.width >= 1 && camera.height >= 1;
    const bool has_range =
        camera.near > 0 && camera.far > camera.near && std::isfinite(camera.far);
    const bool has_place =
        is_finite(camera.eye) && is_finite(camera.forward) && is_finite(camera.up);
    if (!has_lens || !has_range || !has_place)
        throw Error(ErrorCode::bad_argument,
                    "a camera needs an angle of view in (0, pi), a size of at least one pixel, "
                    "0 < near < far and finite vectors");
}

} // namespace

std::array<float, 3> to_floats(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}

DrawnCamera::DrawnCamera(const Camera& camera)
    : eye(camera.eye), near(camera.near), far(camera.far), width(camera.width),
      height(camera.height) {
    require_valid(camera);
    forward = normalized_or_zero(camera.forward);
    right = normalized_or_zero(cross(forward, normalized_or_zero(camera.up)));
    up = cross(right, forward);
    if (length_sq(right) == 0)
        throw Error(ErrorCode::bad_argument, "a camera looks along its up direction");
    slope_y = std::tan(camera.field_of_view / 2);
    slope_x = slope_y * width / height;
}

std::array<float, 16> DrawnCamera::clip_from_world(const Vec3& origin, bool reversed) const {
    const Vec3 shift = origin - eye;
    const double range = far - near;
    // Depth is n (f - w) / (f - n) if it is reversed, else ((f + n) w - 2 f n) / (f - n).
    const double of_depth = reversed ? -near / range : (far + near) / range;
    const double constant = reversed ? near * far / range : -2 * far * near / range;
    const Vec3 rows[4] = {(1 / slope_x) * right, (1 / slope_y) * up, of_depth * forward, forward};
    std::array<float, 16> matrix{};
    for (std::size_t row = 0; row < 4; ++row) {
        matrix[row] = to_float(rows[row].x);
        matrix[4 + row] = to_float(rows[row].y);
        matrix[8 + row] = to_float(rows[row].z);
        matrix[12 + row] = to_float(dot(rows[row], shift) + (row == 2 ? constant : 0));
    }
    return matrix;
}

Vec3 DrawnCamera::project(const Vec3& point) const {
    const Vec3 from_eye = point - eye;
    const double depth = dot(forward, from_eye);
    return {dot(right, from_eye) / (slope_x * depth), dot(up, from_eye) / (slope_y * depth), depth};
}

std::optional<Vec3> on_screen(const Camera& camera, const Vec3& point) {
    const DrawnCamera frame(camera);
    const Vec3 seen = frame.project(point);
    if (!(seen.z >= frame.near))
        return std::nullopt;
    return Vec3{(seen.x + 1) / 2 * frame.width, (1 - seen.y) / 2 * frame.height, seen.z};
}

} // namespace abut
