#pragma once

#include <abut/assembly.h>

#include <nlohmann/json.hpp>
#include <string>

/// The answer of `abut motion`.
namespace abut::command {

/// Returns a table of pairs, a table of parts, and a summary. Starts are rounded down and ends up.
std::string motion_text(const MotionReport& report, const Assembly& assembly);

nlohmann::ordered_json motion_json(const MotionReport& report, const Assembly& assembly);

} // namespace abut::command
