#pragma once

#include <abut/scene.h>

#include <assimp/material.h>
#include <optional>

namespace abut {

/// The diffuse colour of a material, with its opacity as alpha. None if a texture takes its place,
/// or if Assimp invented the material for meshes without one.
///
/// The formats do not say how displays show their colours; they are taken to be sRGB, as in 3MF.
std::optional<Colour> colour_of_material(const aiMaterial& material);

} // namespace abut
