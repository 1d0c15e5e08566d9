#include "io/gltf/gltf_material.h"

#include "io/gltf/gltf_json.h"
#include "io/scene/colour.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace abut {

namespace {

using nlohmann::json;

/// Returns a member that is an object; an empty object if it is missing or of another type.
const json& object_or_empty(const json& object, std::string_view key) {
    static const json empty = json::object();
    const auto found = object.find(key);
    return found == object.end() || !found->is_object() ? empty : *found;
}

struct BaseColour {
    const json& model; ///< a model of reflection
    const char* factor;
    const char* texture;
};

BaseColour base_colour(const json& material) {
    const json& specular =
        object_or_empty(object_or_empty(material, "extensions"), kSpecularGlossinessExtension);
    if (!material.contains("pbrMetallicRoughness") && !specular.empty())
        return {specular, "diffuseFactor", "diffuseTexture"};
    return {object_or_empty(material, "pbrMetallicRoughness"), "baseColorFactor",
            "baseColorTexture"};
}

} // namespace

std::optional<Colour> colour_of_material(const json& material) {
    if (!material.is_object())
        return std::nullopt;
    const auto [model, factor, texture] = base_colour(material);
    if (model.contains(texture))
        return std::nullopt;
    std::array<double, 4> components{1, 1, 1, 1};
    if (const auto found = model.find(factor); found != model.end()) {
        if (!found->is_array() || found->size() != components.size() ||
            !std::all_of(found->begin(), found->end(),
                         [](const json& component) { return component.is_number(); }))
            return std::nullopt;
        components = found->get<std::array<double, 4>>();
    }
    if (text_or_empty(material, "alphaMode") != "BLEND")
        components[3] = 1;
    return display_colour_of_linear(components);
}

json material_of_colour(const Colour& colour) {
    json material{{"pbrMetallicRoughness",
                   {{"baseColorFactor", linear_components(colour)}, {"metallicFactor", 0}}}};
    if (colour.alpha < 255)
        material["alphaMode"] = "BLEND";
    return material;
}

} // namespace abut
