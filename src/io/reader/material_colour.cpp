#include "io/reader/material_colour.h"

#include "io/scene/colour.h"

#include <cstring>

namespace abut {

std::optional<Colour> colour_of_material(const aiMaterial& material) {
    if (std::strcmp(material.GetName().C_Str(), AI_DEFAULT_MATERIAL_NAME) == 0 ||
        material.GetTextureCount(aiTextureType_DIFFUSE) > 0 ||
        material.GetTextureCount(aiTextureType_BASE_COLOR) > 0)
        return std::nullopt;
    aiColor4D diffuse;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != aiReturn_SUCCESS)
        return std::nullopt;
    // Assimp 5.2 gives 0 where a colour of 3MF has no alpha.
    if (diffuse.a == 0)
        diffuse.a = 1;
    float opacity = 1;
    if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS)
        diffuse.a = opacity;
    return display_colour({diffuse.r, diffuse.g, diffuse.b, diffuse.a});
}

} // namespace abut
