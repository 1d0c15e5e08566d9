#include "text/screen.h"

#include <abut/error.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace abut::command {

namespace {

// A colour mark of coloured(): kBegin, a letter of Colour, the coloured text, kEnd.
constexpr char kBegin = '\x0e', kEnd = '\x0f';

struct Character {
    std::size_t bytes; ///< 1 if the character is not valid
    char32_t code;
    bool valid;
};

/// Decodes the first character of the text [Unicode 15, table 3-7].
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80)
        return {1, lead, true};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes)
        return {1, lead, false};
    char32_t code = lead & (0xFFU >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0U) != 0x80)
            return {1, lead, false};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    const bool overlong = bytes == 3 ? code < 0x800 : bytes == 4 && code < 0x10000;
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (overlong || surrogate || code > 0x10FFFF)
        return {1, lead, false};
    return {bytes, code, true};
}

/// Returns whether a terminal interprets the character instead of showing it.
bool is_obeyed(char32_t c) {
    const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0);
    const bool direction = c == 0x061C || c == 0x200E || c == 0x200F ||
                           (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
    return control || direction || c == 0x2028 || c == 0x2029;
}

void append_escape(std::string& out, const Character& c) {
    if (c.code == '\n' || c.code == '\r' || c.code == '\t')
        out += c.code == '\n' ? "\\n" : c.code == '\r' ? "\\r" : "\\t";
    else if (c.code < 0x80 || !c.valid)
        out += fmt::format("\\x{:02x}", static_cast<std::uint32_t>(c.code));
    else
        out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c.code));
}

const char* sequence_of(char colour) {
    switch (static_cast<Colour>(colour)) {
    case Colour::heading:
        return "\x1b[1m";
    case Colour::bad:
        return "\x1b[31m";
    case Colour::doubtful:
        return "\x1b[33m";
    }
    return "";
}

/// Prepares a text for a stream. Colour marks become escape sequences, or nothing if colours are
/// off. Line ends are kept, and all other characters that a terminal interprets are escaped.
std::string for_stream(std::string_view text, std::FILE* stream) {
    const bool colours = has_colours(stream);
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        Character next = first_character(text);
        if (next.code == kBegin && text.size() > 1) {
            out += colours ? sequence_of(text[1]) : "";
            next.bytes = 2;
        } else if (next.code == kEnd) {
            out += colours ? "\x1b[0m" : "";
        } else if (next.code != '\n' && (!next.valid || is_obeyed(next.code))) {
            append_escape(out, next);
        } else {
            out += text.substr(0, next.bytes);
        }
        text.remove_prefix(next.bytes);
    }
    return out;
}

void write_to_standard_output(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0)
        throw Error(ErrorCode::cannot_write, "standard output",
                    std::string("cannot be written: ") + std::strerror(errno));
}

} // namespace

std::string shown(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Character next = first_character(text);
        if (next.valid && !is_obeyed(next.code))
            out += text.substr(0, next.bytes);
        else
            append_escape(out, next);
        text.remove_prefix(next.bytes);
    }
    return out;
}

std::string coloured(Colour colour, std::string_view text) {
    return fmt::format("{}{}{}{}", kBegin, static_cast<char>(colour), text, kEnd);
}

bool has_colours(std::FILE* stream) {
    const char* const refused = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    return isatty(fileno(stream)) != 0 && (refused == nullptr || *refused == '\0') &&
           terminal != nullptr && *terminal != '\0' && std::string_view(terminal) != "dumb";
}

int columns_of(std::FILE* stream) {
    winsize size{};
    if (isatty(fileno(stream)) == 0 || ioctl(fileno(stream), TIOCGWINSZ, &size) != 0)
        return 0;
    return size.ws_col;
}

void print_text(std::string_view text) {
    write_to_standard_output(for_stream(text, stdout));
}

void print_json(std::string_view json) {
    std::string out;
    out.reserve(json.size());
    while (!json.empty()) {
        const Character next = first_character(json);
        if (next.code != '\n' && next.valid && is_obeyed(next.code))
            out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(next.code));
        else
            out += json.substr(0, next.bytes);
        json.remove_prefix(next.bytes);
    }
    write_to_standard_output(out);
}

void print_error(std::string_view message) {
    const std::string line = coloured(Colour::bad, "abut:") + " " + shown(message) + "\n";
    fmt::print(stderr, "{}", for_stream(line, stderr));
}

} // namespace abut::command
