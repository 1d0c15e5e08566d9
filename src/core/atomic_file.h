#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Writes a file so that it appears whole or not at all: to a temporary name beside it, then
/// renamed.
///
/// The temporary is removed on failure.
///
/// Errors      Error{cannot_write}, naming the file.
void write_file_atomically(const std::string& path, std::string_view content);

} // namespace abut
