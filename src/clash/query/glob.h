#pragma once

#include <string_view>

namespace abut {

/// Returns whether a byte of a UTF-8 text continues a character that an earlier byte begins.
inline bool continues_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Returns whether a text matches a glob. `*` matches any run of characters, `?` one character of
/// UTF-8, and any other character itself. Case counts.
bool glob_match(std::string_view glob, std::string_view text);

/// Returns whether a glob matches somewhere in a text. ASCII letters match in either case.
bool glob_found(std::string_view glob, std::string_view text);

} // namespace abut
