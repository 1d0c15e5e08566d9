#pragma once

#include <abut/types.h>

#include <string>
#include <vector>

namespace abut {

/// A line for each model, or group of models, whose box is farther than a clearance from the boxes of
/// all others: no pair across can be found there. It names the two models that are nearest.
///
/// In          files, boxes: of the models; an empty box stands for a model without parts.
std::vector<std::string> warn_of_distant_models(const std::vector<std::string>& files,
                                                const std::vector<Box3>& boxes, double clearance);

/// A length in metres as text of three digits: "0.25 m", "12.5 km".
std::string length_text(double metres);

} // namespace abut
