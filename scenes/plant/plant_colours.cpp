#include "scenes/plant/plant_colours.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace abut::scenes {
namespace {

constexpr Colour kSteel{110, 124, 140}, kGalvanised{172, 178, 182}, kConcrete{198, 196, 190},
    kSafety{228, 184, 46}, kBolt{92, 94, 98}, kVessel{208, 210, 206}, kMachine{62, 104, 128},
    kBoiler{150, 96, 72};

constexpr std::array<std::pair<std::string_view, Colour>, 22> kTypes{{
    {"IfcBeam", kSteel},
    {"IfcColumn", kSteel},
    {"IfcMember", kSteel},
    {"IfcPlate", {158, 172, 182}},
    {"IfcSlab", kConcrete},
    {"IfcFooting", {176, 173, 166}},
    {"IfcChimney", {206, 200, 190}},
    {"IfcRailing", kSafety},
    {"IfcStairFlight", {150, 156, 160}},
    {"IfcPipeSegment", {126, 150, 168}},
    {"IfcPipeFitting", {126, 150, 168}},
    {"IfcDuctSegment", {186, 192, 196}},
    {"IfcDuctFitting", {160, 166, 170}},
    {"IfcCableCarrierSegment", kGalvanised},
    {"IfcCableSegment", {52, 52, 56}},
    {"IfcTank", kVessel},
    {"IfcPump", kMachine},
    {"IfcElectricMotor", {48, 84, 148}},
    {"IfcElectricDistributionBoard", {214, 212, 200}},
    {"IfcMechanicalFastener", kBolt},
    {"IfcDiscreteAccessory", {128, 132, 136}},
    {"IfcBuildingElementProxy", {146, 148, 146}},
}};

/// Water, steam, oil, gas, compressed air and fire water, about as plants mark them.
constexpr std::array<Colour, 6> kSystems{{{74, 134, 92},
                                          {186, 186, 190},
                                          {132, 92, 62},
                                          {214, 170, 62},
                                          {104, 150, 190},
                                          {176, 56, 50}}};

bool contains(std::string_view text, std::string_view word) {
    return text.find(word) != std::string_view::npos;
}

/// The number after the word, such as that of a pipe run.
std::optional<std::size_t> number_after(std::string_view name, std::string_view word) {
    const std::size_t at = name.find(word);
    if (at == std::string_view::npos)
        return std::nullopt;
    const std::string_view digits = name.substr(at + word.size());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), number);
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

} // namespace

std::optional<Colour> colour_of_plant_part(std::string_view type, std::string_view name) {
    if (type.starts_with("IfcPipe")) {
        for (const std::string_view word : {" run ", " line "})
            if (const auto number = number_after(name, word))
                return kSystems[*number % kSystems.size()];
        if (name.starts_with("Boiler"))
            return kBoiler;
        if (contains(name, "ump "))
            return kMachine;
    }
    if (name == "Ground")
        return Colour{142, 146, 132};
    const auto* const found = std::find_if(kTypes.begin(), kTypes.end(),
                                           [&](const auto& entry) { return entry.first == type; });
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

} // namespace abut::scenes
