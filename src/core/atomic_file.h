#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Writes a file so that it appears whole or not at all: to a temporary name beside it, then renamed.
///
/// The temporary is removed on failure; on a signal, by remove_pending_files().
///
/// Errors      Error{cannot_write}, naming the file.
void write_file_atomically(const std::string& path, std::string_view content);

/// Removes the temporary that is being written, if any. Async-signal-safe: for a handler of SIGINT.
void remove_pending_files() noexcept;

} // namespace abut
