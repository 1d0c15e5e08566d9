#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace abut::command {

/// Calls take(number, line) for each line of a text file, from 1, without its end (\n, \r\n or \r)
/// and without a byte-order mark before the first.
///
/// Errors      Error, naming the file: file_not_found; unreadable; malformed for text in UTF-16 or
///             with zero bytes.
void for_each_line(const std::string& file,
                   const std::function<void(std::size_t number, const std::string& line)>& take);

} // namespace abut::command
