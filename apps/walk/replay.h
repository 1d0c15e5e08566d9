#pragma once

#include "arguments.h"

namespace abut::viewer {

/// Replays a path without a window: writes a picture for each frame, and figures.json.
///
/// Errors      Error{unsupported} without EGL or OpenGL 3.3; those of the store, of the tour, and
///             of writing.
void replay(const Arguments& arguments);

} // namespace abut::viewer
