#include <abut/picture.h>

#include "store/database/store_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace abut {

namespace {

struct TypeColour {
    std::string_view word;
    Colour colour;
};

/// Colours of the types of buildings and plants, by a word of the type's name in lower case. The
/// first that matches counts.
constexpr TypeColour kTypeColours[]{
    {"wallstandard", {222, 216, 205}}, {"curtainwall", {170, 197, 212}},
    {"wall", {222, 216, 205}},         {"slab", {196, 195, 190}},
    {"footing", {172, 168, 160}},      {"roof", {186, 120, 98}},
    {"stair", {204, 186, 140}},        {"railing", {226, 184, 60}},
    {"ramp", {204, 186, 140}},         {"window", {142, 190, 214}},
    {"plate", {176, 184, 190}},        {"door", {176, 124, 80}},
    {"beam", {118, 138, 166}},         {"column", {104, 124, 154}},
    {"member", {134, 150, 172}},       {"fastener", {150, 126, 110}},
    {"covering", {214, 206, 190}},     {"furni", {190, 142, 96}},
    {"pipe", {80, 150, 152}},          {"duct", {150, 176, 120}},
    {"cable", {224, 144, 62}},         {"valve", {196, 70, 60}},
    {"pump", {62, 118, 180}},          {"tank", {172, 186, 200}},
    {"boiler", {178, 108, 84}},        {"turbine", {92, 128, 110}},
    {"terminal", {214, 168, 96}},      {"light", {238, 214, 120}},
    {"site", {160, 172, 136}},         {"proxy", {182, 176, 188}},
};

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

/// A 64-bit hash that is equal on every machine [Fowler, Noll, Vo 1a].
std::uint64_t word_hash(std::string_view word) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : word)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash ^ (hash >> 29);
}

/// A soft colour of any hue.
Colour hashed_colour(std::string_view word) {
    const std::uint64_t hash = word_hash(word);
    const double hue = static_cast<double>(hash % 360) / 60;
    const double strong = 0.24 + 0.16 * static_cast<double>((hash >> 20) % 4) / 3;
    const double bright = 0.70 + 0.14 * static_cast<double>((hash >> 40) % 4) / 3;
    const auto channel = [&](double shift) {
        const double k = std::fmod(shift + hue, 6);
        const double part = std::max(0.0, std::min({k, 4 - k, 1.0}));
        return static_cast<std::uint8_t>(std::lround(255 * bright * (1 - strong * part)));
    };
    return {channel(5), channel(3), channel(1)};
}

Colour type_colour(const std::string& type) {
    if (type.empty())
        return {196, 200, 204};
    const std::string lower = lower_case(type);
    for (const TypeColour& each : kTypeColours)
        if (lower.find(each.word) != std::string::npos)
            return each.colour;
    return hashed_colour(lower);
}

} // namespace

const char* to_string(ColourBy by) {
    switch (by) {
    case ColourBy::material:
        return "material";
    case ColourBy::type:
        return "type";
    case ColourBy::file:
        return "file";
    default:
        return "part";
    }
}

std::vector<Colour> part_colours(std::span<const ViewPart> parts, ColourBy by) {
    std::vector<Colour> colours;
    colours.reserve(parts.size());
    for (const ViewPart& part : parts)
        switch (by) {
        case ColourBy::material:
            colours.push_back(part.colour ? *part.colour : type_colour(part.type));
            break;
        case ColourBy::type:
            colours.push_back(type_colour(part.type));
            break;
        case ColourBy::file:
            colours.push_back(hashed_colour(part.file));
            break;
        case ColourBy::part:
            colours.push_back(hashed_colour(part.id));
            break;
        }
    return colours;
}

std::vector<Colour> part_colours(const Store& store, ColourBy by) {
    std::vector<std::pair<std::int64_t, Colour>> found;
    StoreFile& file = store.file();
    for (const ModelRow& model : file.models())
        file.for_each_part(model, [&](const PartRow& row) {
            const ViewPart part{row.part, model.file, row.id, row.name, row.type, {}, row.colour};
            found.emplace_back(row.part, part_colours(std::span(&part, 1), by).front());
        });
    std::ranges::sort(found, {}, &std::pair<std::int64_t, Colour>::first);
    std::vector<Colour> colours;
    colours.reserve(found.size());
    for (const auto& each : found)
        colours.push_back(each.second);
    return colours;
}

} // namespace abut
