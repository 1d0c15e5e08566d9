#pragma once

#include <abut/clash.h>
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

/// Returns a question for each clearance, touch tolerance and tolerated depth of the options that is
/// long beside the models: probably a unit was forgotten, because a number alone is in metres.
///
/// A length is long if it is at least half the longest side of a model's box, or a tenth of it and a
/// metre.
std::vector<std::string> ask_about_lengths(const ClashOptions& options,
                                           const std::vector<Box3>& boxes);

/// Formats a length in metres with at most three significant digits: "0.25 m", "12.5 km".
std::string length_text(double metres);

} // namespace abut
