#include "text/in_words.h"

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

std::string point(const Vec3& place) {
    return direction(place) + " m";
}

std::string direction(const Vec3& way) {
    return fmt::format("({}, {}, {})", number(way.x), number(way.y), number(way.z));
}

} // namespace abut::command
