#include "clash/report/clash_text.h"

#include <abut/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

namespace abut {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Utf8Sequence {
    std::size_t length; ///< bytes of the character, or of the ill-formed part to replace
    bool valid;
};

/// Examines the character that begins at `text[0]`, which is not ASCII.
Utf8Sequence utf8_sequence(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    // The range of the second byte excludes overlong forms, surrogates and values above U+10FFFF.
    unsigned lower = 0x80;
    unsigned upper = 0xBF;
    std::size_t length = 0;
    if (lead >= 0xC2 && lead <= 0xDF) {
        length = 2;
    } else if (lead >= 0xE0 && lead <= 0xEF) {
        length = 3;
        lower = lead == 0xE0 ? 0xA0 : lower;
        upper = lead == 0xED ? 0x9F : upper;
    } else if (lead >= 0xF0 && lead <= 0xF4) {
        length = 4;
        lower = lead == 0xF0 ? 0x90 : lower;
        upper = lead == 0xF4 ? 0x8F : upper;
    } else {
        return {1, false};
    }
    for (std::size_t i = 1; i < length; ++i) {
        if (i >= text.size() || byte(i) < lower || byte(i) > upper)
            return {i, false};
        lower = 0x80;
        upper = 0xBF;
    }
    return {length, true};
}

} // namespace

std::string valid_utf8(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        Utf8Sequence next{1, true};
        if (static_cast<unsigned char>(text[0]) >= 0x80)
            next = utf8_sequence(text);
        out += next.valid ? text.substr(0, next.length) : kReplacement;
        text.remove_prefix(next.length);
    }
    return out;
}

std::string clash_id_text(std::uint64_t id) {
    return fmt::format("{:016x}",
                       id); // text, because not every reader preserves a JSON number of 64 bits
}

std::optional<std::uint64_t> parse_clash_id(std::string_view text) {
    std::uint64_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
    if (error != std::errc() || end != text.data() + text.size() || clash_id_text(id) != text)
        return std::nullopt;
    return id;
}

std::optional<ClashKind> clash_kind_of(std::string_view text) {
    for (const ClashKind kind : kClashKinds)
        if (text == to_string(kind))
            return kind;
    return std::nullopt;
}

double told_distance(const Clash& clash) {
    constexpr double kPicometre = 1e-12;
    return std::abs(clash.distance) <= std::max(clash.rounding, kPicometre) ? 0 : clash.distance;
}

ClashRounding rounding_of_numbers(const Clash& clash) {
    constexpr double kRounding = 0x1p-49; // of a number: some roundings of doubles
    double reach = 0;
    for (const Vec3& p : {clash.point_a, clash.point_b})
        for (const double x : {p.x, p.y, p.z})
            reach = std::max(reach, std::abs(x));
    return {std::max(clash.rounding, kRounding * std::abs(clash.distance)),
            std::max(clash.rounding, kRounding * reach), kRounding};
}

std::string rounded_text(double value, double rounding) {
    constexpr double kLeast = 1e-30, kLongest = 1e15; // digits of numbers beyond mean nothing
    if (!(rounding > kLeast) || !(std::abs(value) < kLongest))
        return fmt::format("{}", value);
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(rounding))));
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals > 0)
        text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text == "-0" ? "0" : text;
}

double rounded(double value, double rounding) {
    if (!std::isfinite(value))
        return value;
    const std::string text = rounded_text(value, rounding);
    double number = value;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

const Part& part_of(const Clash& clash, int side, const std::vector<Scene>& models) {
    const auto s = static_cast<std::size_t>(side);
    if (clash.model[s] >= models.size() || clash.part[s] >= models[clash.model[s]].parts.size())
        throw Error(
            ErrorCode::bad_argument,
            fmt::format("clash {} refers to part {} of model {}, which is not among the models",
                        clash_id_text(clash.id), clash.part[s], clash.model[s]));
    return models[clash.model[s]].parts[clash.part[s]];
}

} // namespace abut
