#pragma once

#include "io/byte_stream.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace abut {

/// Lines of a text, numbered from 1, without their ends (\n or \r\n).
class LineScan {
public:
    /// In          text: must outlive the scan. What has not been taken as a line stays there.
    explicit LineScan(ByteStream& text) : text_(text) {}

    /// False at the end of the text. The line stays where it is until the next one is asked for.
    bool next(std::string_view& line) {
        std::size_t end = text_.ahead().find('\n');
        while (end == std::string_view::npos) {
            const std::size_t searched = text_.ahead().size();
            if (!text_.more())
                break;
            end = text_.ahead().find('\n', searched);
        }
        if (text_.ahead().empty())
            return false;
        line = text_.ahead().substr(0, end);
        text_.take(end == std::string_view::npos ? line.size() : end + 1);
        if (!line.empty() && line.back() == '\r')
            line.remove_suffix(1);
        ++number_;
        return true;
    }
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    /// "line 12", for messages.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }

private:
    ByteStream& text_;
    std::uint64_t number_ = 0;
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
inline std::string_view take_word(ByteStream& text) {
    while (true) {
        std::string_view rest = text.ahead();
        std::string_view word = take_word(rest);
        text.take(text.ahead().size() - rest.size() - word.size()); // blanks
        // What ends where the bytes in memory end may go on.
        if (rest.empty()) {
            if (text.more())
                continue;
            word = text.ahead();
        }
        text.take(word.size());
        return word;
    }
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

/// Whether a word is a number, quickly: from_chars on every coordinate would double the cost of the
/// look.
inline bool looks_like_number(std::string_view word) {
    const std::size_t sign = !word.empty() && (word.front() == '-' || word.front() == '+') ? 1 : 0;
    if (word.size() == sign)
        return false;
    bool simple = word[sign] != '.' || word.size() > sign + 1;
    std::size_t points = 0;
    for (const char c : word.substr(sign)) {
        points += c == '.' ? 1 : 0;
        simple = simple && ((c >= '0' && c <= '9') || c == '.');
    }
    return (simple && points <= 1) || to_number<double>(word).has_value();
}

} // namespace abut
