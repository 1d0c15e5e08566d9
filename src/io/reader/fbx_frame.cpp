#include "io/reader/fbx_frame.h"

#include "io/file/fault.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace abut {

namespace {

/// A row of a quarter turn: one of the file's axes, with a sign.
struct Axis {
    std::int32_t number = 0, sign = 1;
    friend bool operator==(const Axis&, const Axis&) = default;
};

Axis axis(const aiMetadata* settings, const char* number, const char* sign, Axis otherwise) {
    Axis result = otherwise;
    if (settings != nullptr && settings->Get(number, result.number)) {
        result.sign = 1;
        settings->Get(sign, result.sign);
    }
    if (result.number < 0 || result.number > 2 || std::abs(result.sign) != 1)
        malformed("its settings name an axis that does not exist");
    return result;
}

/// Returns the double whose shortest text is that of this float: for example 2.54 for the float
/// next to it.
double as_written(float value) {
    std::array<char, 32> text{};
    const auto [end, fault] = std::to_chars(text.data(), text.data() + text.size(), value);
    double result = value;
    if (fault == std::errc())
        std::from_chars(text.data(), end, result);
    return result;
}

double metres_per_unit(const aiMetadata* settings) {
    double centimetres = 1;
    float single = 0; // Assimp narrows the value to float
    if (settings != nullptr && !settings->Get("UnitScaleFactor", centimetres) &&
        settings->Get("UnitScaleFactor", single))
        centimetres = as_written(single);
    if (!std::isfinite(centimetres) || centimetres <= 0)
        malformed("its settings have a unit that is not a positive number");
    return centimetres / 100;
}

} // namespace

FormatFrame read_fbx_frame(const aiScene& scene, std::vector<NodePart>& parts) {
    const aiMetadata* const settings = scene.mMetaData;
    const double unit = metres_per_unit(settings);
    const std::array<Axis, 3> turn{axis(settings, "CoordAxis", "CoordAxisSign", {0, 1}),
                                   axis(settings, "UpAxis", "UpAxisSign", {1, 1}),
                                   axis(settings, "FrontAxis", "FrontAxisSign", {2, 1})};
    if (turn == std::array<Axis, 3>{{{0, 1}, {2, 1}, {1, -1}}})
        return {unit, UpAxis::z};
    if (turn[0].number + turn[1].number + turn[2].number != 3 || turn[0].number == turn[1].number ||
        turn[1].number == turn[2].number)
        malformed("its settings name an axis twice");
    for (NodePart& part : parts) {
        const Transform before = part.world_from_node;
        for (std::size_t column = 0; column < 12; column += 3)
            for (std::size_t row = 0; row < 3; ++row)
                part.world_from_node.m.at(column + row) =
                    0.0 + turn.at(row).sign *
                              before.m.at(column + static_cast<std::size_t>(turn.at(row).number));
    }
    return {unit, UpAxis::y};
}

} // namespace abut
