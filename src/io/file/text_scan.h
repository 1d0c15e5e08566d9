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

/// Lines of a text, numbered from 1, without their ends (\n, \r\n or \r). A byte-order mark of
/// UTF-8 is passed over.
///
/// Errors      Fault malformed for what is no text in UTF-8 or ASCII: a zero byte, another
///             byte-order mark, a line of more than 64 MiB.
class LineScan {
public:
    /// In          text: must outlive the scan. What has not been taken as a line stays there.
    explicit LineScan(ByteStream& text) : text_(text) {}

    /// False at the end of the text. The line stays where it is until the next one is asked for.
    bool next(std::string_view& line);

    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    /// "line 12", for messages.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }

private:
    void begin();

    ByteStream& text_;
    std::uint64_t number_ = 0;
    char end_ = '\n';           ///< of the first line; others may end otherwise
    std::size_t known_end_ = 0; ///< where the next end_ is ahead, plus one; 0: not known
};

inline bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The next word of a text, taken off it; empty at its end. Line ends count as blanks.
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

/// The same of a text that comes piece by piece. The word stays where it is until the next one is
/// asked for.
///
/// Errors      Fault malformed for a word of more than 64 MiB or one with zero bytes.
std::string_view take_word(ByteStream& text);

/// Without the blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

/// A whole word as a number; none if it is beyond the range of the type.
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

/// A whole word as a real number: a decimal point, an exponent after e or E, nan, inf. Beyond the
/// range of doubles it is infinite or zero.
std::optional<double> to_real(std::string_view word);

/// The three numbers that a vertex begins with.
///
/// Errors      Fault malformed, naming the line and the word that is no number.
Vec3 take_position(std::string_view& rest, const LineScan& lines);

} // namespace abut
