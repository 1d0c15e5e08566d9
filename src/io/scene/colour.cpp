#include "io/scene/colour.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// In          value: not NaN.
std::uint8_t srgb_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

double srgb_of_light(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double light_of_srgb(std::uint8_t byte) {
    const double value = byte / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

} // namespace

std::optional<Colour> display_colour(const std::array<double, 4>& c) {
    if (std::any_of(c.begin(), c.end(), [](double value) { return std::isnan(value); }))
        return std::nullopt;
    return Colour{srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2]), srgb_byte(c[3])};
}

std::optional<Colour> display_colour_of_linear(const std::array<double, 4>& c) {
    return display_colour({srgb_of_light(c[0]), srgb_of_light(c[1]), srgb_of_light(c[2]), c[3]});
}

std::array<double, 4> linear_components(const Colour& colour) {
    return {light_of_srgb(colour.red), light_of_srgb(colour.green), light_of_srgb(colour.blue),
            colour.alpha / 255.0};
}

void ColourTally::add(const std::optional<Colour>& colour, std::uint64_t triangles) {
    std::optional<std::uint32_t> key;
    if (colour)
        key = std::uint32_t{colour->red} << 24 | std::uint32_t{colour->green} << 16 |
              std::uint32_t{colour->blue} << 8 | colour->alpha;
    shares_.try_emplace(key, Share{0, shares_.size()}).first->second.triangles += triangles;
}

std::optional<Colour> ColourTally::largest() const {
    const auto found =
        std::max_element(shares_.begin(), shares_.end(), [](const auto& a, const auto& b) {
            return a.second.triangles != b.second.triangles
                       ? a.second.triangles < b.second.triangles
                       : a.second.turn > b.second.turn;
        });
    if (found == shares_.end() || !found->first)
        return std::nullopt;
    const std::uint32_t key = *found->first;
    const auto byte = [key](unsigned shift) { return static_cast<std::uint8_t>(key >> shift); };
    return Colour{byte(24), byte(16), byte(8), byte(0)};
}

std::string to_string(const Colour& colour) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text = "#";
    const auto append = [&](std::uint8_t byte) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    };
    append(colour.red);
    append(colour.green);
    append(colour.blue);
    if (colour.alpha < 255)
        append(colour.alpha);
    return text;
}

} // namespace abut
