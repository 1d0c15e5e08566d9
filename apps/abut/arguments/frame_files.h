#pragma once

#include <string>
#include <vector>

namespace abut::command {

/// Returns the keyframe files of a sequence, in order.
///
/// In          arguments: a list, whose order is kept, or one shell pattern ("frame-*.ply").
///             Matches of a pattern are sorted by name with digits compared as numbers: frame-2
///             before frame-10.
/// Errors      Error{file_not_found} if nothing matches the pattern; Error{bad_argument} if there
///             is only one keyframe.
std::vector<std::string> frame_files(const std::vector<std::string>& arguments);

} // namespace abut::command
