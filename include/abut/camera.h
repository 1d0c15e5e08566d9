#pragma once

#include <abut/shapes.h>
#include <abut/types.h>

#include <array>
#include <cstdint>

namespace abut {

/// A perspective camera. Lengths are in the model's units (metres), world frame.
struct Camera {
    Vec3 eye{0, 0, 0};
    Vec3 forward{0, 1, 0}; ///< viewing direction; need not have unit length
    Vec3 up{0, 0, 1};      ///< need not be perpendicular to `forward`, but not parallel to it
    double field_of_view = 1.0471975511965976; ///< vertical angle in radians, in (0, pi)
    std::uint32_t width = 1280, height = 720;  ///< of the picture, in pixels; at least 1
    double near = 0.05, far = 10'000;          ///< clipping distances, 0 < near < far
};

/// Returns the matrix from world minus `origin` to clip space (OpenGL: each axis in [-w, w]), in
/// column-major order. Relative to an origin near the eye, single precision is enough far from the
/// world's origin.
///
/// Errors      Error{bad_argument} if the camera is not as its members say.
std::array<float, 16> clip_from_world(const Camera& camera, const Vec3& origin = {});

/// Returns the ray from the eye through a pixel; (0, 0) is the top left corner of the picture, so
/// the middle of the first pixel is (0.5, 0.5). The direction has unit length.
Ray ray_through(const Camera& camera, double x, double y);

/// Returns the length at distance 1 from the eye that a pixel covers, in the middle of the picture.
double length_of_pixel(const Camera& camera);

/// Returns the camera that sees the whole box from a direction: `towards` is where it looks.
Camera look_at_box(const Box3& box, const Vec3& towards, const Vec3& up, const Camera& lens = {});

} // namespace abut
