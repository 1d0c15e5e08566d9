#pragma once

#include <fstream>
#include <string>

namespace abut {

/// Opens a small text file, such as one of rules, that is read as a whole.
///
/// Errors      Error{file_not_found} "no such file" if nothing has this path; Error{unreadable} if it
///             cannot be opened. Both name the file.
std::ifstream open_text(const std::string& path);

} // namespace abut
