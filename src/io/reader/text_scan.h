#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace abut {

/// Lines of a text, numbered from 1, without their ends (\n or \r\n).
class LineScan {
public:
    explicit LineScan(std::string_view text) : rest_(text) {}

    /// False at the end of the text.
    bool next(std::string_view& line) {
        if (rest_.empty())
            return false;
        const std::size_t end = rest_.find('\n');
        line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (!line.empty() && line.back() == '\r')
            line.remove_suffix(1);
        ++number_;
        return true;
    }
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    /// "line 12", for messages.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }
    /// What follows the lines that were taken.
    [[nodiscard]] std::string_view rest() const noexcept { return rest_; }

private:
    std::string_view rest_;
    std::uint64_t number_ = 0;
};

/// The next word of a text, taken off it; empty at its end. Line ends count as blanks.
inline std::string_view take_word(std::string_view& text) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    const std::size_t start = text.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) {
        text = {};
        return {};
    }
    const std::size_t end = text.find_first_of(kBlanks, start);
    const std::string_view word = text.substr(start, end - start);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end);
    return word;
}

/// A whole word as a number.
template <typename Number>
std::optional<Number> to_number(std::string_view word) {
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    Number value{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    // Beyond the range of the type is a number still; that it is not finite is found later.
    if (word.empty() || end != word.data() + word.size() || fault == std::errc::invalid_argument)
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
