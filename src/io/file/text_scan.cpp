#include "io/file/text_scan.h"

#include "io/file/fault.h"

#include <array>
#include <limits>

namespace abut {

namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 20;
/// The end of the first line is searched for this far. Without one, lines are assumed to end with
/// \n.
constexpr std::size_t kFirstLine = std::size_t{64} << 10;

[[noreturn]] void no_text(const std::string& place) {
    malformed(place + ": contains zero bytes, so it is not UTF-8 text");
}

} // namespace

void LineScan::begin() {
    (void)text_.has(4);
    const std::string_view first = text_.ahead();
    if (first.starts_with("\xff\xfe") || first.starts_with("\xfe\xff"))
        malformed("is UTF-16 text: save it as UTF-8");
    if (first.starts_with("\xef\xbb\xbf"))
        text_.take(3);
    // Files of old programs end their lines with a single \r.
    std::size_t end = text_.ahead().find_first_of("\r\n");
    while (end == std::string_view::npos && text_.ahead().size() < kFirstLine && text_.more())
        end = text_.ahead().find_first_of("\r\n");
    if (end != std::string_view::npos && text_.ahead()[end] == '\r' &&
        (!text_.has(end + 2) || text_.ahead()[end + 1] != '\n'))
        end_ = '\r';
}

bool LineScan::next(std::string_view& line) {
    if (number_ == 0)
        begin();
    std::size_t end = known_end_ > 0 ? known_end_ - 1 : text_.ahead().find(end_);
    while (end == std::string_view::npos) {
        const std::size_t searched = text_.ahead().size();
        if (text_.ahead().find('\0') != std::string_view::npos)
            no_text("line " + std::to_string(number_ + 1));
        if (searched > kLongestLine)
            malformed("line " + std::to_string(number_ + 1) + " is longer than 64 MiB");
        if (!text_.more())
            break;
        end = text_.ahead().find(end_, searched);
    }
    if (text_.ahead().empty())
        return false;
    line = text_.ahead().substr(0, end);
    known_end_ = 0;
    std::size_t taken = end == std::string_view::npos ? line.size() : end + 1;
    if (!line.empty() && end_ == '\n' && line.back() == '\r')
        line.remove_suffix(1);
    // A file that was joined from several may mix line ends.
    const std::size_t other = line.find(end_ == '\n' ? '\r' : '\n');
    if (other != std::string_view::npos) {
        line = line.substr(0, other);
        taken = other + 1;
        if (end != std::string_view::npos)
            known_end_ = end - taken + 1;
    }
    text_.take(taken);
    ++number_;
    if (line.find('\0') != std::string_view::npos)
        no_text(place());
    return true;
}

std::string_view take_word(ByteStream& text) {
    while (true) {
        std::string_view rest = text.ahead();
        std::string_view word = take_word(rest);
        text.take(text.ahead().size() - rest.size() - word.size()); // blanks
        // A word at the end of the bytes in memory may continue in the file.
        if (rest.empty()) {
            if (word.size() > kLongestLine)
                malformed("contains a word of more than 64 MiB");
            if (word.find('\0') != std::string_view::npos)
                malformed("contains zero bytes among its numbers");
            if (text.more())
                continue;
            word = text.ahead();
        }
        text.take(word.size());
        return word;
    }
}

std::optional<double> to_real(std::string_view word) {
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || fault == std::errc::invalid_argument)
        return std::nullopt;
    if (fault == std::errc())
        return value;
    // Out of range: the sign of the exponent, or the position of the first digit, tells which way.
    const bool minus = word.front() == '-';
    const std::size_t exponent = word.find_first_of("eE");
    const std::size_t digit = word.find_first_of("123456789");
    const bool small = exponent != std::string_view::npos && digit < exponent
                           ? word[exponent + 1] == '-'
                           : word.find('.') < digit;
    value = small ? 0 : std::numeric_limits<double>::infinity();
    return minus ? -value : value;
}

Vec3 take_position(std::string_view& rest, const LineScan& lines) {
    std::array<double, 3> xyz{};
    for (double& value : xyz) {
        const std::string_view word = take_word(rest);
        const auto number = to_real(word);
        if (!number)
            malformed(lines.place() + ": a vertex needs three numbers" +
                      (word.empty() ? std::string()
                                    : ", not \"" + std::string(word.substr(0, 40)) + "\""));
        value = *number;
    }
    return {xyz[0], xyz[1], xyz[2]};
}

} // namespace abut
