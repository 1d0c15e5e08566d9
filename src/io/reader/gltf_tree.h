#pragma once

#include <abut/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// What the JSON of a glTF or GLB file says of nodes and of the sizes of meshes. Assimp keeps node
/// transforms as floats, which moves a building in survey coordinates by centimetres; here they
/// stay the doubles that JSON holds.
struct GltfTree {
    struct Node {
        std::string name; ///< may be empty
        std::string extras_name;
        std::string extras_type;
        Transform parent_from_node;
        std::int64_t mesh = -1; ///< index in meshes; -1: none
        std::vector<std::uint32_t> children;
    };
    /// Of one primitive; triangles is 0 for points and lines.
    struct Primitive {
        std::uint64_t vertices = 0;
        std::uint64_t triangles = 0;
        bool is_surface = true; ///< its mode is one of triangles, strip, fan
    };
    std::vector<Node> nodes;
    std::vector<std::vector<Primitive>> meshes;
    std::vector<std::uint32_t> roots; ///< of the scene that is shown first
};

/// Reads and checks the JSON: sizes against the file's and the buffers' lengths, indices of all
/// kinds, that the nodes form trees, that no extension is required that changes geometry.
///
/// Errors      Fault malformed, unsupported, unreadable; nlohmann::json::exception for wrong types
///             and missing keys.
GltfTree read_gltf_tree(const std::string& file, bool binary);

} // namespace abut
