#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/picture.h>
#include <abut/properties.h>

#include "store/database/store_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>
#include <unordered_map>

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

struct ClashColour {
    ClashKind kind = ClashKind::hard;
    Colour colour;
};
/// The kinds from the worst on.
constexpr ClashColour kClashColours[]{
    {ClashKind::hard, {214, 50, 40}},       {ClashKind::undecided, {190, 90, 60}},
    {ClashKind::contained, {156, 60, 170}}, {ClashKind::duplicate, {82, 84, 196}},
    {ClashKind::touch, {236, 146, 40}},     {ClashKind::clearance, {236, 208, 72}}};
constexpr Colour kNone{206, 210, 214};         ///< of a part without a clash or a storey
constexpr std::string_view kStorey = "storey"; ///< the property

/// The word that gives a part its colour.
struct ColourWord {
    std::string word;
    Colour colour;
};

ColourWord word_of_storey(std::string_view storey) {
    return {std::string(storey), storey.empty() ? kNone : hashed_colour(storey)};
}

ColourWord word_of(const ViewPart& part, ColourBy by) {
    switch (by) {
    case ColourBy::material:
        return {"", part.colour ? *part.colour : type_colour(part.type)};
    case ColourBy::type:
        return {part.type, type_colour(part.type)};
    case ColourBy::file:
        return {part.file, hashed_colour(part.file)};
    case ColourBy::part:
        return {"", hashed_colour(part.id)};
    default:
        return {"", kNone};
    }
}

std::string key_of(const std::string& file, const std::string& id) {
    return file + '\n' + id;
}

/// The place of a part's worst clash in kClashColours, by file and id.
std::unordered_map<std::string, std::size_t> worst_clashes(const Store& store) {
    std::unordered_map<std::string, std::size_t> worst;
    for (const ClashReview& review : review_clashes(store))
        for (const ListedClash& clash : review.clashes) {
            if (clash.status == ClashStatus::resolved)
                continue;
            const auto place = static_cast<std::size_t>(
                std::ranges::find(kClashColours, clash.kind, &ClashColour::kind) - kClashColours);
            for (std::size_t side = 0; side < 2; ++side) {
                const auto [at, is_new] =
                    worst.try_emplace(key_of(clash.file.at(side), clash.part.at(side)), place);
                if (!is_new)
                    at->second = std::min(at->second, place);
            }
        }
    return worst;
}

/// A part of a store, and the word that gives it its colour.
struct FoundWord {
    std::int64_t part;
    ColourWord word;
};

void take_storeys(StoreFile& file, std::vector<FoundWord>& found) {
    std::vector<std::int64_t> parts;
    parts.reserve(found.size());
    for (const FoundWord& each : found)
        parts.push_back(each.part);
    const std::array<std::string, 1> names{std::string(kStorey)};
    const Properties properties = file.properties(parts, names);
    for (std::uint32_t i = 0; i < found.size(); ++i)
        found[i].word = word_of_storey(properties.value(i, kStorey));
}

/// The words of all parts, in the order of their rows.
std::vector<ColourWord> words_of(const Store& store, ColourBy by) {
    const auto worst = by == ColourBy::clash ? worst_clashes(store)
                                             : std::unordered_map<std::string, std::size_t>();
    std::vector<FoundWord> found;
    StoreFile& file = store.file();
    for (const ModelRow& model : file.models())
        file.for_each_part(model, [&](const PartRow& row) {
            const ViewPart part{row.part, model.file, row.id, row.name, row.type, {}, row.colour};
            ColourWord word = word_of(part, by);
            if (const auto clash = worst.find(key_of(part.file, part.id)); clash != worst.end())
                word = {abut::to_string(kClashColours[clash->second].kind), // NOLINT
                        kClashColours[clash->second].colour};               // NOLINT
            found.push_back({row.part, std::move(word)});
        });
    std::ranges::sort(found, {}, &FoundWord::part);
    if (by == ColourBy::storey)
        take_storeys(file, found);
    std::vector<ColourWord> words;
    words.reserve(found.size());
    for (FoundWord& each : found)
        words.push_back(std::move(each.word));
    return words;
}

/// The words of all parts, model by model.
std::vector<ColourWord> words_of(const std::vector<Scene>& models, ColourBy by) {
    if (by == ColourBy::clash)
        throw Error(ErrorCode::bad_argument,
                    "colours by clash need a store, with the clashes of its last jobs");
    std::vector<ColourWord> words;
    for (const Scene& scene : models)
        for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
            const Part& part = scene.parts[i];
            words.push_back(
                by == ColourBy::storey
                    ? word_of_storey(scene.properties.value(i, kStorey))
                    : word_of({0, scene.file, part.id, part.name, part.type, {}, part.colour}, by));
        }
    return words;
}

/// Sorts the groups by their size, and renumbers those of the parts.
void sort_legend(PartColouring& colouring) {
    std::vector<std::uint32_t> order(colouring.legend.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](std::uint32_t i) { return colouring.legend[i].parts; });
    std::vector<PartColouring::Group> sorted;
    for (const std::uint32_t i : order) {
        place[i] = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(std::move(colouring.legend[i]));
    }
    colouring.legend = std::move(sorted);
    for (std::uint32_t& group : colouring.groups)
        group = place[group];
}

PartColouring colouring_of(const std::vector<ColourWord>& words, ColourBy by) {
    PartColouring colouring;
    colouring.colours.reserve(words.size());
    for (const ColourWord& each : words)
        colouring.colours.push_back(each.colour);
    if (by == ColourBy::material || by == ColourBy::part)
        return colouring;
    std::unordered_map<std::string, std::uint32_t> numbers;
    for (const ColourWord& each : words) {
        const std::string word = each.word.empty() ? "none" : each.word;
        const auto next = static_cast<std::uint32_t>(colouring.legend.size());
        const auto [at, is_new] = numbers.try_emplace(word, next);
        if (is_new)
            colouring.legend.push_back({word, each.colour, 0});
        ++colouring.legend[at->second].parts;
        colouring.groups.push_back(at->second);
    }
    sort_legend(colouring);
    return colouring;
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
    case ColourBy::part:
        return "part";
    case ColourBy::storey:
        return "storey";
    default:
        return "clash";
    }
}

std::vector<Colour> part_colours(std::span<const ViewPart> parts, ColourBy by) {
    std::vector<Colour> colours;
    colours.reserve(parts.size());
    for (const ViewPart& part : parts)
        colours.push_back(word_of(part, by).colour);
    return colours;
}

PartColouring part_colouring(const Store& store, ColourBy by) {
    return colouring_of(words_of(store, by), by);
}

PartColouring part_colouring(const std::vector<Scene>& models, ColourBy by) {
    return colouring_of(words_of(models, by), by);
}

std::vector<Colour> part_colours(const std::vector<Scene>& models, ColourBy by) {
    return part_colouring(models, by).colours;
}

std::vector<Colour> part_colours(const Store& store, ColourBy by) {
    return part_colouring(store, by).colours;
}

} // namespace abut
