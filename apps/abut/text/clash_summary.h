#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace abut::command {

/// Returns a report as text for the terminal: models, counts by kind, the deepest and the nearest
/// pairs, times and memory.
/// "0.01 mm, precision of a.ifc": the touch tolerance of a report.
std::string touch_in_words(const ClashReport& report);
/// The touch tolerance of a question.
std::string touch_in_words(const std::optional<double>& touch_tolerance);

std::string summary(const ClashReport& report, const std::vector<Scene>& models);

} // namespace abut::command
