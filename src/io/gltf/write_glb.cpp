#include <abut/error.h>
#include <abut/scene.h>

#include "core/atomic_file.h"
#include "io/gltf/gltf_json.h"
#include "io/scene/model_frame.h"
#include "math/rounding.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

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

json node_of(const Part& part, UpAxis up) {
    json node{{"name", part.id}, {"mesh", part.mesh}};
    if (part.name != part.id)
        node["extras"]["name"] = part.name;
    if (!part.type.empty())
        node["extras"]["type"] = part.type;
    const Transform world_from_mesh = turned(part.world_from_mesh, up, *kGltfFrame.up);
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
    json meshes = json::array();
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        vertices += scene.meshes[i].positions.size();
        const json attributes{{"POSITION", 2 * i}};
        meshes.push_back({{"primitives", {{{"attributes", attributes}, {"indices", 2 * i + 1}}}}});
    }
    json nodes = json::array();
    json roots = json::array();
    for (const Part& part : scene.parts) {
        roots.push_back(nodes.size());
        nodes.push_back(node_of(part, scene.up));
    }
    document["meshes"] = std::move(meshes);
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
