#include <abut/error.h>
#include <abut/scene.h>

#include "core/atomic_file.h"
#include "io/gltf/gltf_extras.h"
#include "io/gltf/gltf_json.h"
#include "io/gltf/gltf_material.h"
#include "io/scene/model_frame.h"
#include "math/rounding.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut {

namespace {

using nlohmann::json;

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::size_t kVertexBytes = 12;
constexpr std::size_t kTriangleBytes = 12;

void append_word(std::string& bytes, std::uint32_t word) {
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

json mesh_accessors(const Scene& scene, std::string& binary) {
    json accessors = json::array();
    std::size_t vertex = 0;
    std::size_t triangle = 0;
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes)
        vertices += mesh.positions.size();
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    binary.resize(vertices * kVertexBytes + triangles * kTriangleBytes);
    char* const indices = binary.data() + vertices * kVertexBytes;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();

    for (const Mesh& mesh : scene.meshes) {
        std::array<float, 3> lower{kInfinity, kInfinity, kInfinity};
        std::array<float, 3> upper{-kInfinity, -kInfinity, -kInfinity};
        accessors.push_back({{"bufferView", 0},
                             {"byteOffset", vertex * kVertexBytes},
                             {"componentType", kFloat},
                             {"count", mesh.positions.size()},
                             {"type", "VEC3"}});
        for (const Vec3& p : mesh.positions) {
            const std::array<float, 3> xyz{to_float(p.x), to_float(p.y), to_float(p.z)};
            for (std::size_t k = 0; k < 3; ++k) {
                lower[k] = std::min(lower[k], xyz[k]);
                upper[k] = std::max(upper[k], xyz[k]);
            }
            std::memcpy(binary.data() + vertex++ * kVertexBytes, xyz.data(), kVertexBytes);
        }
        if (!mesh.positions.empty()) {
            accessors.back()["min"] = lower;
            accessors.back()["max"] = upper;
        }
        accessors.push_back({{"bufferView", 1},
                             {"byteOffset", triangle * kTriangleBytes},
                             {"componentType", kUnsignedInt},
                             {"count", 3 * mesh.triangles.size()},
                             {"type", "SCALAR"}});
        if (!mesh.triangles.empty())
            std::memcpy(indices + triangle * kTriangleBytes, mesh.triangles.data(),
                        mesh.triangles.size() * kTriangleBytes);
        triangle += mesh.triangles.size();
    }
    return accessors;
}

/// The meshes of the document. In glTF the mesh names the material, so a mesh that is shown in
/// several colours is repeated for each, with the same accessors.
class ColouredMeshes {
public:
    explicit ColouredMeshes(const Scene& scene)
        : colours_(scene.meshes.size()), is_used_(scene.meshes.size()) {
        for (std::size_t i = 0; i < scene.meshes.size(); ++i)
            meshes_.push_back(mesh_of(i));
    }

    std::size_t number_of(const Part& part) {
        if (part.mesh >= colours_.size())
            return part.mesh; // not a valid scene
        if (!is_used_[part.mesh])
            colour(part.mesh, part.colour);
        is_used_[part.mesh] = true;
        if (colours_[part.mesh] == part.colour)
            return part.mesh;
        const auto [found, is_new] =
            others_.try_emplace({part.mesh, key(part.colour)}, meshes_.size());
        if (is_new) {
            meshes_.push_back(mesh_of(part.mesh));
            colour(found->second, part.colour);
        }
        return found->second;
    }

    void finish(json& document) {
        document["meshes"] = std::move(meshes_);
        if (!materials_.empty())
            document["materials"] = std::move(materials_);
    }

private:
    static json mesh_of(std::size_t i) {
        const json attributes{{"POSITION", 2 * i}};
        return {{"primitives", {{{"attributes", attributes}, {"indices", 2 * i + 1}}}}};
    }
    static std::string key(const std::optional<Colour>& colour) {
        return colour ? to_string(*colour) : "";
    }
    void colour(std::size_t mesh, const std::optional<Colour>& colour) {
        if (mesh < colours_.size())
            colours_[mesh] = colour;
        if (!colour)
            return;
        const auto [found, is_new] = material_of_.try_emplace(key(colour), materials_.size());
        if (is_new)
            materials_.push_back(material_of_colour(*colour));
        meshes_[mesh]["primitives"][0]["material"] = found->second;
    }

    std::vector<std::optional<Colour>> colours_; ///< of each mesh of the scene: of its first part
    std::vector<bool> is_used_;
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> others_; ///< by mesh and colour
    std::map<std::string, std::size_t> material_of_;
    json meshes_ = json::array(), materials_ = json::array();
};

json node_of(const Scene& scene, std::uint32_t number, std::size_t mesh) {
    const Part& part = scene.parts[number];
    json node{{"name", part.id}, {"mesh", mesh}};
    if (part.name != part.id)
        node["extras"]["name"] = part.name;
    if (!part.type.empty())
        node["extras"]["type"] = part.type;
    if (json properties = json_of_properties(scene.properties, number); !properties.is_null())
        node["extras"]["properties"] = std::move(properties);
    const Transform world_from_mesh = turned(part.world_from_mesh, scene.up, *kGltfFrame.up);
    if (world_from_mesh != Transform()) {
        const auto& m = world_from_mesh.m;
        node["matrix"] = {m[0], m[1], m[2], 0, m[3], m[4],  m[5],  0,
                          m[6], m[7], m[8], 0, m[9], m[10], m[11], 1};
    }
    return node;
}

} // namespace

void write_glb(const Scene& scene, const std::string& path) {
    std::string binary;
    json document{{"asset", {{"version", "2.0"}, {"generator", "Abut"}}}, {"scene", 0}};
    document["accessors"] = mesh_accessors(scene, binary);
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes)
        vertices += mesh.positions.size();
    ColouredMeshes meshes(scene);
    json nodes = json::array();
    json roots = json::array();
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
        roots.push_back(i);
        nodes.push_back(node_of(scene, i, meshes.number_of(scene.parts[i])));
    }
    meshes.finish(document);
    document["nodes"] = std::move(nodes);
    document["scenes"] = {{{"nodes", std::move(roots)}}};
    document["buffers"] = {{{"byteLength", binary.size()}}};
    const std::size_t vertex_bytes = vertices * kVertexBytes;
    document["bufferViews"] = {{{"buffer", 0},
                                {"byteOffset", 0},
                                {"byteLength", vertex_bytes},
                                {"byteStride", kVertexBytes},
                                {"target", kArrayBuffer}},
                               {{"buffer", 0},
                                {"byteOffset", vertex_bytes},
                                {"byteLength", binary.size() - vertex_bytes},
                                {"target", kElementArrayBuffer}}};

    // Bytes that are not UTF-8 are replaced, because JSON cannot contain them.
    std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    constexpr std::size_t kHeaders = 12 + 8 + 8;
    const std::size_t length = kHeaders + text.size() + binary.size();
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::cannot_write, path, "is larger than a GLB file can be (4 GiB)");

    std::string bytes;
    bytes.reserve(length);
    for (const std::uint32_t word :
         {kGlbMagic, std::uint32_t{2}, static_cast<std::uint32_t>(length),
          static_cast<std::uint32_t>(text.size()), kJsonChunk})
        append_word(bytes, word);
    bytes += text;
    append_word(bytes, static_cast<std::uint32_t>(binary.size()));
    append_word(bytes, kBinaryChunk);
    bytes += binary;
    write_file_atomically(path, bytes);
}

} // namespace abut
