#pragma once

#include <abut/camera.h>
#include <abut/types.h>

namespace abut {

/// The axes of a camera, and its slopes: a point right + up + forward from the eye is in the picture
/// if |right| <= slope_x * forward and |up| <= slope_y * forward.
struct CameraFrame {
    /// Errors      Error{bad_argument} if the camera is not as its members say.
    explicit CameraFrame(const Camera& camera);

    Vec3 eye;
    Vec3 right, up, forward; ///< orthonormal, world frame
    double slope_x = 0, slope_y = 0;
};

} // namespace abut
