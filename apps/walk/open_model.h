#pragma once

#include <abut/progress.h>

#include <string>
#include <vector>

namespace abut::viewer {

/// Returns the path of a store with levels of detail: the given store, or one in the cache folder
/// into which the models are imported.
///
/// Errors      those of import_models and build_levels; Error{cannot_write} if there is no cache
///             folder; Error{interrupted}: what was done until then is kept.
std::string ready_store(const std::vector<std::string>& files, const Progress& progress);

/// Shows a stage and its percentage in one line of a terminal; nothing if it is quiet, or standard
/// error is no terminal.
Progress terminal_progress(bool quiet);

} // namespace abut::viewer
