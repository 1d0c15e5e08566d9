#pragma once

#include <abut/camera.h>
#include <abut/types.h>

#include "view/camera/camera_frame.h"

#include <array>

namespace abut {

/// A camera with what the shaders need of it.
struct DrawnCamera : CameraFrame {
    /// Errors      Error{bad_argument} if the camera is not as its members say.
    explicit DrawnCamera(const Camera& camera)
        : CameraFrame(camera), near(camera.near), far(camera.far), width(camera.width),
          height(camera.height) {}

    /// The matrix from world minus origin to clip space. With `reversed`, depth runs from 1 at the
    /// near plane to 0 at the far plane, for a clip space with z in [0, w].
    [[nodiscard]] std::array<float, 16> clip_from_world(const Vec3& origin, bool reversed) const;
    /// Returns (right, up, depth) of a point; right and up are in [-1, 1] within the picture.
    [[nodiscard]] Vec3 project(const Vec3& point) const;
    /// The length that a pixel covers at depth 1.
    [[nodiscard]] double pixel() const { return 2 * slope_y / height; }

    double near, far;
    std::uint32_t width, height;
};

std::array<float, 3> to_floats(const Vec3& v);

} // namespace abut
