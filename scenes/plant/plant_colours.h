#pragma once

#include <abut/scene.h>

#include <optional>
#include <string_view>

namespace abut::scenes {

/// The colour of a part of a plant: by its type, and of pipes by their system, which the number in
/// the name chooses.
std::optional<Colour> colour_of_plant_part(std::string_view type, std::string_view name);

} // namespace abut::scenes
