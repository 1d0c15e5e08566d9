#pragma once

#include <abut/tour.h>

namespace abut {

/// Returns the camera of a point, with the lens of another one.
Camera camera_of(const TourPoint& point, const Camera& lens);

} // namespace abut
