#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace abut::command {

/// Calls take(number, line) for each line of a text file. Numbers begin at 1. Line ends (\n, \r\n
/// or \r) and a leading byte-order mark are removed.
///
/// Errors      Error, naming the file: file_not_found; unreadable; malformed for text in UTF-16 or
///             with zero bytes.
void for_each_line(const std::string& file,
                   const std::function<void(std::size_t number, const std::string& line)>& take);

} // namespace abut::command
