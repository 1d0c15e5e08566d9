#include <abut/error.h>
#include <abut/renderer.h>
#include <abut/shape_queries.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

constexpr std::array<double, 5> kStops{0, 0.25, 0.5, 0.75, 1};
constexpr std::array<Colour, 5> kRamp{
    {{214, 38, 30}, {242, 140, 38}, {242, 222, 77}, {115, 199, 102}, {89, 153, 217}}};

} // namespace

Colour distance_colour(double part) {
    const double at = std::isnan(part) ? 1 : std::clamp(part, 0.0, 1.0);
    const auto i = std::min(static_cast<std::size_t>(at * 4), kStops.size() - 2);
    const double t = (at - kStops.at(i)) / (kStops.at(i + 1) - kStops.at(i));
    const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround((1 - t) * a + t * b));
    };
    const Colour &a = kRamp.at(i), &b = kRamp.at(i + 1);
    return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

DistanceColours distances_from(std::uint32_t part, const Model& model,
                               const Transform& world_from_part, double reach) {
    if (!(reach > 0) || !std::isfinite(reach))
        throw Error(ErrorCode::bad_argument, "the reach of distances must be positive");
    DistanceColours colours;
    colours.reach = reach;
    colours.distance = [=](std::uint32_t seen, const Vec3& point) {
        if (seen == part)
            return reach;
        return nearest(model, world_from_part, point, {.upper_bound = reach}).distance;
    };
    return colours;
}

} // namespace abut
