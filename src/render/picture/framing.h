#pragma once

#include <abut/picture.h>

#include "view/camera/fit_camera.h"

namespace abut {

/// Returns where a named view looks.
ViewDirection direction_of(NamedView view, UpAxis up);

/// Sets the clipping distances of a camera so that a whole box is drawn.
Camera with_range(Camera camera, const Box3& box);

} // namespace abut
