#pragma once

#include <abut/scene.h>

#include <string>

namespace abut::test {

/// Reads a file by read_scene and by streaming, expects the same scene of both, and returns it.
///
/// In          folder: for temporary files.
Scene read_both_ways(const std::string& path, const std::string& folder);

} // namespace abut::test
