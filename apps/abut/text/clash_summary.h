#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace abut::command {

/// The touch tolerance of a question.
std::string touch_in_words(const std::optional<double>& touch_tolerance);

/// Returns a report as text for the terminal: models, counts by kind, the deepest and the nearest
/// pairs, times and memory.
///
/// In          rules_have_clearances: a rule or a cell of a matrix has a clearance of its own.
std::string summary(const ClashReport& report, const std::vector<Scene>& models,
                    bool rules_have_clearances);

} // namespace abut::command
