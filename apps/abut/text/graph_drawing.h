#pragma once

#include <abut/store_clash.h>

#include <string>

namespace abut::command {

/// Draws the lines of a graph as SVG, seen along the axis of the model's least extent. Each work
/// unit has its own colour. A circle at the middle of its parts has the unit's number in the order
/// of work; its radius grows with the unit's bytes.
std::string draw(const GraphReport& graph);

} // namespace abut::command
