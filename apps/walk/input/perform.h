#pragma once

#include "input/action.h"
#include "toolbox/tools.h"

namespace abut::viewer {

/// Does what a key or a button asks for.
///
/// Errors      those of the tools.
void perform(Action action, Session& session, Tools& tools);

} // namespace abut::viewer
