#pragma once

#include <string_view>

namespace abut {

/// Whether a text matches a glob. `*` matches any run of characters, `?` one character (a byte),
/// and any other character itself. Case counts.
bool glob_match(std::string_view glob, std::string_view text);

/// Whether a glob matches somewhere in a text. ASCII letters match in either case.
bool glob_found(std::string_view glob, std::string_view text);

} // namespace abut
