#pragma once

#include <abut/types.h>

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace abut {

/// Layout of a GLB file:
///
///     header  u32 magic "glTF" | u32 version | u32 length of the file
///     chunk   u32 length | u32 kind | bytes …    the first is JSON, the second binary
inline constexpr std::uint32_t kGlbMagic = 0x46546c67;    // "glTF"
inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a;   // "JSON"
inline constexpr std::uint32_t kBinaryChunk = 0x004e4942; // "BIN"
inline constexpr std::uint64_t kGlbHeaderBytes = 12;
inline constexpr std::uint64_t kChunkHeaderBytes = 8;

/// Types of an accessor's components.
inline constexpr std::uint16_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122,
                               kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

/// Returns a member of an object; an empty array if it is missing.
const nlohmann::json& member_or_empty(const nlohmann::json& object, const char* key);

/// Returns a member that is an index or a size, or `fallback` if it is missing.
///
/// Errors      Fault malformed if the member is not a valid index or size.
std::uint64_t number_or(const nlohmann::json& object, const char* key, std::uint64_t fallback);

/// Returns a text member; empty if it is missing or not a text.
std::string text_or_empty(const nlohmann::json& object, const char* key);

/// Returns parent_from_node, from the node's matrix or from its translation, rotation and scale.
///
/// Errors      Fault malformed: a wrong count of numbers, a projective matrix, a rotation of zero
///             length.
Transform gltf_transform(const nlohmann::json& node);
/// Scales, then rotates by the quaternion x y z w, then translates.
///
/// Errors      Fault malformed for a rotation of zero length.
Transform gltf_transform(const std::array<double, 3>& translation,
                         const std::array<double, 4>& rotation, const std::array<double, 3>& scale);

/// Extensions whose geometry is read.
inline constexpr std::string_view kInstancingExtension = "EXT_mesh_gpu_instancing";
inline constexpr std::string_view kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr std::array<std::string_view, 2> kMeshoptExtensions{"EXT_meshopt_compression",
                                                                    "KHR_meshopt_compression"};

/// An earlier model of materials, whose colours are read.
inline constexpr std::string_view kSpecularGlossinessExtension =
    "KHR_materials_pbrSpecularGlossiness";

/// Returns whether a file may require an extension: one whose geometry is read, or one that does
/// not change geometry, such as materials, lights, textures and metadata.
bool is_known_gltf_extension(std::string_view name);

} // namespace abut
