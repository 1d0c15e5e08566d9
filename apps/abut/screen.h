#pragma once

#include <cstdio>
#include <string>
#include <string_view>

/// The one way of text to standard output and standard error.
///
/// Names of parts, files and messages come from others. A terminal obeys some characters that they
/// may hold: escape sequences move the cursor, retitle the window or recolour what is read; marks of
/// direction reorder it. Such characters are printed as escapes (`\x1b`, `\u202e`) whatever the
/// output is, so that what a script reads is what a person sees.
namespace abut::command {

/// The text of others within ours: one line, with nothing in it that a terminal obeys.
///
/// Escaped are control characters (C0, with line ends and tabs; DEL; C1), the marks that set the
/// direction of text (the property Bidi_Control of Unicode), the separators of lines and paragraphs
/// (U+2028, U+2029), and bytes that are no UTF-8.
std::string shown(std::string_view text);

enum class Colour : char { heading = 'h', bad = 'b', doubtful = 'd' };

/// Marks text of ours with a colour. print_text and print_error turn the mark into the sequence of a
/// terminal, or into nothing where colours are off; `shown` lets no mark of others through.
std::string coloured(Colour colour, std::string_view text);

/// Whether colours are on: the stream is a terminal that is not dumb, and NO_COLOR is not set.
bool has_colours(std::FILE* stream);

/// Columns of the terminal that the stream is; 0 if it is none.
int columns_of(std::FILE* stream);

/// Writes text of several lines to standard output, all at once. All but line ends is escaped as in
/// `shown`.
///
/// Errors      Error{cannot_write} naming standard output.
void print_text(std::string_view text);

/// Writes JSON to standard output, all at once. In its strings, what a terminal obeys is escaped as
/// JSON has it (`\u009b`), so that its meaning stays the same.
///
/// Errors      as print_text.
void print_json(std::string_view json);

/// Writes "abut: MESSAGE" to standard error, in one line.
void print_error(std::string_view message);

} // namespace abut::command
