#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Writes a file so that it appears complete or not at all. The content goes to a temporary file in
/// the same folder, which is then renamed.
///
/// The temporary file is removed on failure.
///
/// Errors      Error{cannot_write}, naming the file.
void write_file_atomically(const std::string& path, std::string_view content);

} // namespace abut
