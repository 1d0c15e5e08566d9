#include "in_words.h"

#include <fmt/format.h>

namespace abut::command {

std::string number(double value, int digits) {
    return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);
}

std::string metres(double value) {
    return number(value) + " m";
}

std::string point(const Vec3& place) {
    return direction(place) + " m";
}

std::string direction(const Vec3& way) {
    return fmt::format("({}, {}, {})", number(way.x), number(way.y), number(way.z));
}

} // namespace abut::command
