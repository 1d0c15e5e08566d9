#pragma once

#include <cstdio>
#include <string>
#include <string_view>

/// The only functions that write text to standard output and standard error.
///
/// Names of parts and files, and some messages, are untrusted. A terminal interprets some
/// characters that they may contain: escape sequences move the cursor, retitle the window or
/// recolour the text; direction marks reorder it. Such characters are printed as escapes (`\x1b`,
/// `\u202e`) on any output, so that a script reads what a person sees.
namespace abut::command {

/// Escapes an untrusted text, so that it is one line that a terminal does not interpret.
///
/// It escapes control characters (C0, with line ends and tabs; DEL; C1), the marks that set the
/// direction of text (the property Bidi_Control of Unicode), the separators of lines and paragraphs
/// (U+2028, U+2029), and bytes that are not UTF-8.
std::string shown(std::string_view text);

enum class Colour : char { heading = 'h', bad = 'b', doubtful = 'd' };

/// Marks a trusted text with a colour. print_text and print_error turn the mark into an escape
/// sequence, or remove it if colours are off. `shown` escapes marks in untrusted text.
std::string coloured(Colour colour, std::string_view text);

/// Returns whether colours are on: the stream is a terminal that is not dumb, and NO_COLOR is not
/// set.
bool has_colours(std::FILE* stream);

/// Returns the number of columns of the terminal; 0 if the stream is not a terminal.
int columns_of(std::FILE* stream);

/// Writes text of one or more lines to standard output, all at once. It is escaped as by `shown`,
/// except line ends and colour marks.
///
/// Errors      Error{cannot_write} naming standard output.
void print_text(std::string_view text);

/// Writes JSON to standard output, all at once. Characters in its strings that a terminal
/// interprets are written as JSON escapes (`\u009b`), which do not change the meaning.
///
/// Errors      as print_text.
void print_json(std::string_view json);

/// Writes "abut: MESSAGE" to standard error, in one line.
void print_error(std::string_view message);

} // namespace abut::command
