#pragma once

#include <abut/types.h>

#include <string>
#include <vector>

namespace abut {

/// Returns a warning for each model, or group of models, whose box is farther than the clearance
/// from the boxes of all others. No clash with another model can be found there. The warning names
/// the two models that are nearest.
///
/// In          files, boxes: of the models; a model without parts has an empty box.
std::vector<std::string> warn_of_distant_models(const std::vector<std::string>& files,
                                                const std::vector<Box3>& boxes, double clearance);

/// Formats a length in metres with at most three significant digits: "0.25 m", "12.5 km".
std::string length_text(double metres);

} // namespace abut
