#pragma once

#include <string>

namespace abut {

/// Returns the path of a file that a model refers to.
///
/// A model is not trusted: each file that it refers to must lie in the model's folder or below it,
/// also after symbolic links are followed. The model's own path comes from the user and may be a
/// link; its folder is then the one that contains the link.
///
/// In          reference: as in the model, relative to its folder.
/// Errors      Fault unsupported if the file lies outside and allow_outside is false.
std::string companion_path(const std::string& model, const std::string& reference,
                           bool allow_outside);

} // namespace abut
