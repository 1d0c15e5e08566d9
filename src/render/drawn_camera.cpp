#include "render/drawn_camera.h"

#include <abut/renderer.h>

#include "math/rounding.h"
#include "math/vector.h"

namespace abut {

std::array<float, 3> to_floats(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
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
