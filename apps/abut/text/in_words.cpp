#include "text/in_words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace abut::command {

std::string number(double value, int digits) {
    return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);
}

std::string number_below(double value) {
    // A step is at most one unit of the last digit.
    for (double shown = value;; shown -= 1e-6 * std::abs(value))
        if (std::string text = number(shown); std::stod(text) <= value)
            return text;
}

std::string number_above(double value) {
    for (double shown = value;; shown += 1e-6 * std::abs(value))
        if (std::string text = number(shown); std::stod(text) >= value)
            return text;
}

std::string metres(double value) {
    return number(value) + " m";
}

std::string short_length(double value) {
    constexpr double kCentimetre = 0.01;
    return value > 0 && value < kCentimetre ? number(1000 * value, 3) + " mm" : metres(value);
}

std::string metres_below(double value) {
    return number_below(value) + " m";
}

std::string metres_above(double value) {
    return number_above(value) + " m";
}

double step_below(double length) {
    return length > 0 ? std::pow(10.0, std::floor(std::log10(length))) : 0;
}

std::string to_step(double value, double step) {
    constexpr double kLeast = 1e-30, kLongest = 1e15; // digits of numbers beyond mean nothing
    if (!(step > kLeast) || !(std::abs(value) < kLongest))
        return number(value);
    const int decimals = std::max(0, static_cast<int>(std::lround(-std::log10(step))));
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals > 0)
        text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string box_text(const Vec3& lower, const Vec3& upper, double rounding) {
    const double diagonal = std::hypot(upper.x - lower.x, upper.y - lower.y, upper.z - lower.z);
    const double reach = std::max({std::abs(lower.x), std::abs(lower.y), std::abs(lower.z),
                                   std::abs(upper.x), std::abs(upper.y), std::abs(upper.z)});
    // Some roundings of coordinates in double precision.
    const double step = step_below(std::max({rounding, 1e-6 * diagonal, 0x1p-50 * reach}));
    const auto corner = [&](const Vec3& p) {
        return fmt::format("({}, {}, {})", to_step(p.x, step), to_step(p.y, step),
                           to_step(p.z, step));
    };
    return corner(lower) + " to " + corner(upper) + " m";
}

std::string point(const Vec3& place) {
    return direction(place) + " m";
}

std::string direction(const Vec3& way) {
    return fmt::format("({}, {}, {})", number(way.x), number(way.y), number(way.z));
}

} // namespace abut::command
