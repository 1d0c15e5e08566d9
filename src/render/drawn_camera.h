#pragma once

#include <abut/camera.h>
#include <abut/types.h>

#include <array>
#include <optional>

namespace abut {

/// A camera as the shaders need it: orthonormal axes and the slopes of the picture's borders.
struct DrawnCamera {
    Vec3 eye, right, up, forward;       ///< unit vectors, world
    double slope_x = 1, slope_y = 1;    ///< of the right and the upper border of the picture
    double near = 0.05, far = 10'000;
    std::uint32_t width = 1, height = 1;

    /// Errors      Error{bad_argument} if the camera is not as its members say.
    explicit DrawnCamera(const Camera& camera);

    /// The matrix from world minus origin to clip space. With `reversed`, depth runs from 1 at the
    /// near plane to 0 at the far plane, for a clip space with z in [0, w].
    [[nodiscard]] std::array<float, 16> clip_from_world(const Vec3& origin, bool reversed) const;
    /// Returns (right, up, depth) of a point; right and up are in [-1, 1] within the picture.
    [[nodiscard]] Vec3 project(const Vec3& point) const;
    /// The length that a pixel covers at depth 1.
    [[nodiscard]] double pixel() const { return 2 * slope_y / height; }
};

std::array<float, 3> to_floats(const Vec3& v);

} // namespace abut
