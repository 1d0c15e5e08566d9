#pragma once

#include <fmt/format.h>
#include <string_view>

/// Writes CSV as RFC 4180 defines it: a header, CRLF, quotes where a cell needs them; UTF-8 without
/// a byte-order mark.
///
/// A spreadsheet takes a cell that begins with = + - @ | for a formula or a command, even if the
/// cell is quoted, in full width (East Asian forms) or after white space. The texts come from
/// untrusted model files. Such a text therefore gets a leading apostrophe, which marks it as text
/// for a spreadsheet. Numbers are written by this library and stay as they are. Programs that need
/// the unaltered texts read the JSON report.
namespace abut {

/// Text under construction; fmt::format_to appends to it.
using TextBuffer = fmt::memory_buffer;

inline void append(TextBuffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

/// Appends a comma and the text.
void append_cell(TextBuffer& out, std::string_view raw);
/// Appends a comma and the number; a number that is not finite leaves its cell empty.
void append_cell(TextBuffer& out, double value);
/// As above, the number as rounded_text() writes it.
void append_rounded_cell(TextBuffer& out, double value, double rounding);

} // namespace abut
