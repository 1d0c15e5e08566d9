#include "io/gltf/gltf_json.h"

#include "io/file/fault.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

using nlohmann::json;

namespace {

template <std::size_t count>
std::array<double, count> numbers(const json& node, const char* key,
                                  const std::array<double, count>& fallback) {
    const auto found = node.find(key);
    if (found == node.end())
        return fallback;
    if (!found->is_array() || found->size() != count)
        malformed(std::string("a node's ") + key + " does not have " + std::to_string(count) +
                  " numbers");
    return found->get<std::array<double, count>>();
}

Transform matrix_transform(const json& node) {
    const std::array<double, 16> m = numbers<16>(node, "matrix", {});
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        malformed("a node's matrix is not affine: its last row is not 0 0 0 1");
    return Transform({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]});
}

} // namespace

const json& member_or_empty(const json& object, const char* key) {
    static const json empty = json::array();
    const auto found = object.find(key);
    return found == object.end() ? empty : *found;
}

std::uint64_t number_or(const json& object, const char* key, std::uint64_t fallback) {
    const auto found = object.find(key);
    if (found == object.end())
        return fallback;
    // A double or a negative number is not a valid index.
    if (!found->is_number_unsigned())
        malformed(std::string("its JSON gives a wrong number for ") + key);
    return found->get<std::uint64_t>();
}

std::string text_or_empty(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

Transform gltf_transform(const json& node) {
    if (node.contains("matrix"))
        return matrix_transform(node);
    return gltf_transform(numbers<3>(node, "translation", {0, 0, 0}),
                          numbers<4>(node, "rotation", {0, 0, 0, 1}),
                          numbers<3>(node, "scale", {1, 1, 1}));
}

Transform gltf_transform(const std::array<double, 3>& t, const std::array<double, 4>& rotation,
                         const std::array<double, 3>& s) {
    auto [x, y, z, w] = rotation;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length > 0))
        malformed("a node's rotation has zero length");
    // A unit quaternion stored as floats is off by 1e-8; its length carries no meaning.
    x /= length, y /= length, z /= length, w /= length;
    return Transform({s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
                      s[0] * 2 * (x * z - y * w), s[1] * 2 * (x * y - z * w),
                      s[1] * (1 - 2 * (x * x + z * z)), s[1] * 2 * (y * z + x * w),
                      s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
                      s[2] * (1 - 2 * (x * x + y * y)), t[0], t[1], t[2]});
}

bool is_known_gltf_extension(std::string_view name) {
    constexpr std::array<std::string_view, 13> kKnown{
        kInstancingExtension,       kDracoExtension,         kMeshoptExtensions[0],
        kMeshoptExtensions[1],      "KHR_mesh_quantization", "KHR_xmp_json_ld",
        "KHR_animation_pointer",    "KHR_node_hoverability", "KHR_node_selectability",
        "EXT_mesh_features",        "EXT_instance_features", "EXT_structural_metadata",
        "CESIUM_primitive_outline",
    };
    constexpr std::array<std::string_view, 5> kKinds{"_materials_", "_texture_", "_lights_",
                                                     "_techniques_", "_ngon_"};
    return std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end() ||
           std::any_of(kKinds.begin(), kKinds.end(), [&](std::string_view kind) {
               return name.find(kind) != std::string_view::npos;
           });
}

} // namespace abut
