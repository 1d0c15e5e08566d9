#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace abut {

/// The lines of a text, numbered from 1, without their ends (\n, \r\n or \r). A UTF-8 byte-order
/// mark is skipped.
///
/// Errors      Fault malformed if the text is not UTF-8 or ASCII: a zero byte, another byte-order
///             mark, or a line of more than 64 MiB.
class LineScan {
public:
    /// In          text: must outlive the scan. Bytes after the last line taken stay in it.
    explicit LineScan(ByteStream& text) : text_(text) {}

    /// False at the end of the text. The line stays valid until the next call.
    bool next(std::string_view& line);

    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    /// The current line for messages, such as "line 12".
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }

private:
    void begin();

    ByteStream& text_;
    std::uint64_t number_ = 0;
    char end_ = '\n';           ///< end of the first line; others may differ
    std::size_t known_end_ = 0; ///< position after the next end_ in memory; 0: not known
};

inline bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Removes the next word from a text and returns it; empty at the end. Line ends count as blanks.
inline std::string_view take_word(std::string_view& text) {
    std::size_t start = 0;
    while (start < text.size() && is_blank(text[start]))
        ++start;
    std::size_t end = start;
    while (end < text.size() && !is_blank(text[end]))
        ++end;
    const std::string_view word = text.substr(start, end - start);
    text.remove_prefix(end);
    return word;
}

/// As above for a stream. The word stays valid until the next call.
///
/// Errors      Fault malformed for a word of more than 64 MiB or with a zero byte.
std::string_view take_word(ByteStream& text);

/// Returns the text without the blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

/// Converts a whole word to a number; none if it is not one or exceeds the type's range.
template <typename Number>
std::optional<Number> to_number(std::string_view word) {
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    Number value{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size())
        return std::nullopt;
    return value;
}

/// Converts a whole word to a real number: with a decimal point, an exponent after e or E, nan or
/// inf. A number beyond the range of doubles becomes infinite or zero.
std::optional<double> to_real(std::string_view word);

/// Takes the three numbers that a vertex begins with.
///
/// Errors      Fault malformed, naming the line and the word that is not a number.
Vec3 take_position(std::string_view& rest, const LineScan& lines);

} // namespace abut
