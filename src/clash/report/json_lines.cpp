#include "clash/report/json_lines.h"

#include <cmath>
#include <cstdint>

namespace abut {

using nlohmann::ordered_json;

ordered_json json_number(double value) {
    constexpr double kMostDigits = 1e15; // beyond, nlohmann writes an exponent
    const bool is_whole = std::abs(value) < kMostDigits && value == std::trunc(value);
    // Readers take "-0" for an integer, which has no sign.
    if (is_whole && !(value == 0 && std::signbit(value)))
        return static_cast<std::int64_t>(value);
    return value;
}

ordered_json json_point(const Vec3& point) {
    ordered_json result = ordered_json::array();
    auto& numbers = result.get_ref<ordered_json::array_t&>();
    numbers.reserve(3);
    for (const double value : {point.x, point.y, point.z})
        numbers.push_back(json_number(value));
    return result;
}

void JsonLines::key(std::string_view name) {
    begin_item();
    append(name);
    text_ += ':';
    after_key_ = true;
}

void JsonLines::value(const ordered_json& json) {
    begin_item();
    append(json);
}

void JsonLines::members(const ordered_json& object) {
    for (const auto& [name, json] : object.items())
        member(name, json);
}

void JsonLines::begin_item() {
    if (!after_key_ && !text_.empty())
        text_ += is_first_ ? "\n" : ",\n";
    after_key_ = false;
    is_first_ = false;
}

void JsonLines::open(char bracket) {
    begin_item();
    text_ += bracket;
    is_first_ = true;
}

void JsonLines::close(char bracket) {
    text_ += '\n';
    text_ += bracket;
    is_first_ = false;
}

void JsonLines::append(const ordered_json& json) {
    const std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    std::size_t done = 0;
    for (std::size_t at = 0; (at = text.find('<', done)) != std::string::npos; done = at + 1) {
        text_.append(text, done, at - done);
        text_ += "\\u003c"; // `<` occurs in strings only
    }
    text_.append(text, done);
}

} // namespace abut
