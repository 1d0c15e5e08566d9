#pragma once

#include "arguments.h"

namespace abut::viewer {

/// Opens the window and returns when it is closed.
///
/// Errors      Error{unsupported} if there is no display or no OpenGL 3.3; those of the store.
void show_window(const Arguments& arguments);

} // namespace abut::viewer
