#pragma once

#include <abut/store_clash.h>

#include <string>

namespace abut::command {

/// The lines of a graph as SVG, seen along the axis along which the model reaches least; each unit has
/// a colour of its own, in the order of work, and a ring of its bytes at the middle of its parts.
std::string draw(const GraphReport& graph);

} // namespace abut::command
