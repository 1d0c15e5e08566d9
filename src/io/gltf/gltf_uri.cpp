#include "io/gltf/gltf_uri.h"

#include "io/file/fault.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace abut {

namespace {

constexpr std::uint8_t kNoDigit = 0xff;

std::uint8_t base64_digit(char c) {
    static const auto table = [] {
        std::array<std::uint8_t, 256> digits{};
        digits.fill(kNoDigit);
        std::uint8_t value = 0;
        for (const char digit :
             std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
            digits[static_cast<unsigned char>(digit)] = value++;
        // The URL-safe alphabet (RFC 4648, 5), which some writers use.
        digits['-'] = 62, digits['_'] = 63;
        return digits;
    }();
    return table[static_cast<unsigned char>(c)];
}

std::vector<std::byte> from_base64(std::string_view text) {
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding)
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        malformed("a data: URI is truncated");
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t word = 0;
    unsigned bits = 0;
    for (const char c : text) {
        const std::uint8_t digit = base64_digit(c);
        if (digit == kNoDigit)
            malformed("a data: URI is not base64");
        word = word << 6 | digit;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::byte>(word >> bits & 0xff));
        }
    }
    return bytes;
}

std::optional<unsigned> hexadecimal(char c) {
    if (c >= '0' && c <= '9')
        return static_cast<unsigned>(c - '0');
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (lower >= 'a' && lower <= 'f')
        return static_cast<unsigned>(lower - 'a' + 10);
    return std::nullopt;
}

/// Returns whether the text begins with a scheme: a letter, then letters, digits, "+-.", then a
/// colon. A Windows drive looks like a scheme.
bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 &&
           std::isalpha(static_cast<unsigned char>(uri.front())) != 0 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' ||
                      c == '.';
           });
}

} // namespace

std::optional<std::vector<std::byte>> bytes_of_data_uri(std::string_view uri) {
    constexpr std::string_view kScheme = "data:";
    if (uri.size() < kScheme.size() ||
        !std::equal(kScheme.begin(), kScheme.end(), uri.begin(), [](char a, char b) {
            return a == std::tolower(static_cast<unsigned char>(b));
        }))
        return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        malformed("a data: URI has no content");
    if (!uri.substr(0, comma).ends_with(";base64"))
        throw Fault(ErrorCode::unsupported, "has a data: URI that is not in base64");
    return from_base64(uri.substr(comma + 1));
}

std::string path_of_uri(std::string_view uri) {
    if (has_scheme(uri))
        throw Fault(ErrorCode::unsupported, "refers to " + std::string(uri.substr(0, 200)) +
                                                ": only files beside the model are read");
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char c = uri[i];
        if (c == '%') {
            const auto high = i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : std::nullopt;
            const auto low = high ? hexadecimal(uri[i + 2]) : std::nullopt;
            if (!low)
                malformed("the URI " + std::string(uri.substr(0, 200)) +
                          " has a percent sign without two digits");
            c = static_cast<char>(*high * 16 + *low);
            i += 2;
        }
        if (c == '\0')
            malformed("a URI contains a zero byte");
        path += c;
    }
    return path;
}

} // namespace abut
