#pragma once

#include <string>
#include <vector>

namespace abut::command {

/// The frames of a sequence, in order.
///
/// In          a list, which is taken as it is; or one pattern as a shell has them
///             ("frame-*.ply"). Its matches are ordered by name, and digits in it as numbers:
///             frame-2 before frame-10.
/// Errors      Error{file_not_found} if nothing matches the pattern; Error{bad_argument} if there is
///             one frame only.
std::vector<std::string> frame_files(const std::vector<std::string>& arguments);

} // namespace abut::command
