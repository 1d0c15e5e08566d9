#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut::command {

/// Returns a report as text for the terminal: models, counts by kind, the deepest and the nearest
/// pairs, times and memory.
std::string summary(const ClashReport& report, const std::vector<Scene>& models);

} // namespace abut::command
