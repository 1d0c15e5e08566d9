#pragma once

#include <cstdint>
#include <string>

namespace abut {

/// Returns a path's extension in lower case, with its dot.
std::string lower_extension(const std::string& path);

/// A regular file, open for reading.
struct OpenFile {
    int descriptor = -1; ///< the caller closes it
    std::uint64_t size = 0;
};

/// Opens a regular file. Errors as readable_size.
OpenFile open_readable(const std::string& path);

/// Checks that a file can be opened, and returns its size in bytes.
///
/// Errors      Fault: file_not_found; unreadable, also if it is not a regular file; malformed if it
///             is empty.
std::uint64_t readable_size(const std::string& path);

/// Returns all bytes of a file. Errors as readable_size.
std::string read_file(const std::string& path);

} // namespace abut
