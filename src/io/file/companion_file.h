#pragma once

#include <string>

namespace abut {

/// Path of a file that a model refers to.
///
/// A model may come from anywhere, so what it refers to has to lie in the model's own folder or
/// below it, also once symbolic links are followed. The model's own path is the user's: it may be
/// a link, and then the folder is the one that the link lies in.
///
/// In          reference: as in the model, relative to its folder.
/// Errors      Fault unsupported if the file lies outside and allow_outside is false.
std::string companion_path(const std::string& model, const std::string& reference,
                           bool allow_outside);

} // namespace abut
