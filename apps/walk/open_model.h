#pragma once

#include <string>
#include <vector>

namespace abut::viewer {

/// Returns the path of a store with levels of detail: the given store, or one in the cache folder
/// into which the models are imported. Prints what takes long on standard error, unless quiet.
///
/// Errors      those of import_models and build_levels; Error{cannot_write} if there is no cache
///             folder.
std::string ready_store(const std::vector<std::string>& files, bool quiet);

} // namespace abut::viewer
