#pragma once

#include <abut/scene.h>

#include <nlohmann/json.hpp>
#include <optional>

namespace abut {

/// The colour of a glTF material: its base colour, or else the diffuse colour of
/// KHR_materials_pbrSpecularGlossiness. A material that gives neither is white, as glTF defines.
/// Alpha is used only where the material blends.
///
/// Returns none for a material with a texture in place of a colour, and for one that is not valid.
std::optional<Colour> colour_of_material(const nlohmann::json& material);

/// The material that has this colour, for write_glb.
nlohmann::json material_of_colour(const Colour& colour);

} // namespace abut
