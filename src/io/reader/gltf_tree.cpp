#include "io/reader/gltf_tree.h"

#include "io/fault.h"
#include "io/gltf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

namespace abut {

namespace {

using nlohmann::json;

std::string read_bytes(std::ifstream& stream, std::uint64_t size) {
    std::string bytes(size, '\0');
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw Fault(ErrorCode::unreadable, "cannot be read");
    return bytes;
}

template <std::size_t count>
std::array<std::uint32_t, count> read_words(std::ifstream& stream) {
    std::array<std::uint32_t, count> words{};
    std::memcpy(words.data(), read_bytes(stream, sizeof words).data(), sizeof words);
    return words;
}

struct GlbFile {
    std::string json;
    std::uint64_t binary_size = 0; ///< of the chunk that buffer 0 lies in
};

/// The JSON chunk of a GLB file, and the size of the binary one.
///
///     header  u32 magic "glTF" | u32 version | u32 length of the file
///     chunk   u32 length | u32 kind | bytes …    the first is JSON, the second binary
GlbFile read_glb(std::ifstream& stream, std::uint64_t file_size) {
    if (file_size < kGlbHeaderBytes + kChunkHeaderBytes)
        malformed("is too short for a GLB file");
    const auto [magic, version, length] = read_words<3>(stream);
    if (magic != kGlbMagic)
        malformed("is no GLB file");
    if (version != 2)
        throw Fault(ErrorCode::unsupported,
                    "is glTF version " + std::to_string(version) + ", only 2 is read");
    if (length > file_size)
        malformed("is truncated: " + std::to_string(file_size) + " of " + std::to_string(length) +
                  " bytes");
    GlbFile glb;
    for (std::uint64_t at = kGlbHeaderBytes; at + kChunkHeaderBytes <= length;) {
        const auto [size, kind] = read_words<2>(stream);
        at += kChunkHeaderBytes;
        if (size > length - at)
            malformed("is truncated: a chunk reaches beyond its end");
        if (glb.json.empty()) {
            if (kind != kJsonChunk)
                malformed("its first chunk is not JSON");
            glb.json = read_bytes(stream, size);
        } else {
            if (kind == kBinaryChunk)
                glb.binary_size = size;
            stream.seekg(size, std::ios::cur);
        }
        at += size;
    }
    return glb;
}

json parse(const std::string& text) {
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        malformed("its JSON breaks off or is wrong at byte " + std::to_string(error.byte));
    }
}

std::uint64_t index_of(const json& value, std::size_t count, const char* what) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
        malformed(std::string("its JSON refers to ") + what + " " + value.dump() +
                  ", which does not exist");
    return value.get<std::uint64_t>();
}

/// Bytes of a component, by its type's number.
std::uint64_t component_bytes(const json& accessor) {
    switch (number_or(accessor, "componentType", 0)) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        malformed("an accessor has an unknown component type");
    }
}

/// Checks sizes along accessor, view and buffer.
class Accessors {
public:
    explicit Accessors(const json& document)
        : accessors_(member_or_empty(document, "accessors")),
          views_(member_or_empty(document, "bufferViews")),
          buffers_(member_or_empty(document, "buffers")) {}

    /// Elements of an accessor that lies whole within its buffer.
    std::uint64_t checked_count(const json& reference, std::uint64_t components) const {
        const json& accessor = accessors_[index_of(reference, accessors_.size(), "accessor")];
        const std::uint64_t count = number_or(accessor, "count", 0);
        if (!accessor.contains("bufferView"))
            return count; // all zeros, or sparse
        const json& view = views_[index_of(accessor["bufferView"], views_.size(), "buffer view")];
        const json& buffer = buffers_[index_of(view.at("buffer"), buffers_.size(), "buffer")];
        const std::uint64_t size = component_bytes(accessor) * components;
        const std::uint64_t stride = number_or(view, "byteStride", size);
        const std::uint64_t view_size = number_or(view, "byteLength", 0);
        const std::uint64_t view_start = number_or(view, "byteOffset", 0);
        const std::uint64_t buffer_size = number_or(buffer, "byteLength", 0);
        const std::uint64_t start = number_or(accessor, "byteOffset", 0);
        constexpr std::uint64_t kLargest = std::uint64_t{1} << 40;
        if (std::max({count, stride, start, view_start, view_size, buffer_size}) > kLargest ||
            stride > 252)
            malformed("a buffer view has an impossible size");
        if (count > 0 && start + stride * (count - 1) + size > view_size)
            malformed("accessor " + reference.dump() + " reaches beyond its buffer view");
        if (view_start + view_size > buffer_size)
            malformed("buffer view " + accessor["bufferView"].dump() +
                      " reaches beyond its buffer");
        return count;
    }

    [[nodiscard]] const json& accessor(const json& reference) const {
        return accessors_[index_of(reference, accessors_.size(), "accessor")];
    }

private:
    const json& accessors_;
    const json& views_;
    const json& buffers_;
};

GltfTree::Primitive read_primitive(const json& primitive, const Accessors& accessors) {
    const json& attributes = primitive.at("attributes");
    const std::uint64_t mode = number_or(primitive, "mode", 4);
    GltfTree::Primitive result;
    result.is_surface = mode >= 4 && mode <= 6;
    const auto position = attributes.find("POSITION");
    if (!result.is_surface)
        return result;
    if (position == attributes.end())
        malformed("a primitive has no positions");
    const json& accessor = accessors.accessor(*position);
    if (text_or_empty(accessor, "type") != "VEC3")
        malformed("positions are not of type VEC3");
    if (number_or(accessor, "componentType", 0) != 5126)
        throw Fault(ErrorCode::unsupported, "positions are not floats");
    result.vertices = accessors.checked_count(*position, 3);
    const auto indices = primitive.find("indices");
    const std::uint64_t corners =
        indices == primitive.end() ? result.vertices : accessors.checked_count(*indices, 1);
    if (mode == 4 && corners % 3 != 0)
        malformed("the indices of a primitive are not a multiple of three");
    result.triangles = mode == 4 ? corners / 3 : corners - std::min<std::uint64_t>(corners, 2);
    return result;
}

GltfTree::Node read_node(const json& node, std::size_t nodes, std::size_t meshes) {
    GltfTree::Node result;
    result.name = text_or_empty(node, "name");
    const auto extras = node.find("extras");
    if (extras != node.end()) {
        result.extras_name = text_or_empty(*extras, "name");
        result.extras_type = text_or_empty(*extras, "type");
    }
    if (node.contains("mesh"))
        result.mesh = static_cast<std::int64_t>(index_of(node["mesh"], meshes, "mesh"));
    for (const json& child : member_or_empty(node, "children"))
        result.children.push_back(static_cast<std::uint32_t>(index_of(child, nodes, "node")));
    result.parent_from_node = gltf_transform(node);
    return result;
}

/// A node with two parents, or one that is its own ancestor, would be read forever.
void check_trees(const GltfTree& tree) {
    std::vector<bool> has_parent(tree.nodes.size());
    const auto take = [&](std::uint32_t node) {
        if (has_parent[node])
            malformed("node " + std::to_string(node) + " has two parents");
        has_parent[node] = true;
    };
    for (const GltfTree::Node& node : tree.nodes)
        for (const std::uint32_t child : node.children)
            take(child);
    for (const std::uint32_t root : tree.roots)
        take(root);
}

void check_extensions(const json& document) {
    for (const json& extension : member_or_empty(document, "extensionsRequired")) {
        const std::string name = extension.get<std::string>();
        if (!is_harmless_gltf_extension(name))
            throw Fault(ErrorCode::unsupported, "needs the glTF extension " + name);
    }
}

} // namespace

GltfTree read_gltf_tree(const std::string& file, bool binary) {
    std::ifstream stream(file, std::ios::binary);
    const std::uint64_t size = std::filesystem::file_size(file);
    const GlbFile content = binary ? read_glb(stream, size) : GlbFile{read_bytes(stream, size), 0};
    const json document = parse(content.json);
    if (!document.is_object() || !document.contains("asset"))
        malformed("is no glTF file");
    if (text_or_empty(document["asset"], "version").rfind("2.", 0) != 0)
        throw Fault(ErrorCode::unsupported, "is not glTF 2");
    check_extensions(document);

    for (const json& buffer : member_or_empty(document, "buffers"))
        if (!buffer.contains("uri") && number_or(buffer, "byteLength", 0) > content.binary_size)
            malformed("its buffer is longer than the file's binary part");

    GltfTree tree;
    const Accessors accessors(document);
    for (const json& mesh : member_or_empty(document, "meshes")) {
        auto& primitives = tree.meshes.emplace_back();
        for (const json& primitive : mesh.at("primitives"))
            primitives.push_back(read_primitive(primitive, accessors));
    }
    const json& nodes = member_or_empty(document, "nodes");
    tree.nodes.reserve(nodes.size());
    for (const json& node : nodes)
        tree.nodes.push_back(read_node(node, nodes.size(), tree.meshes.size()));
    const json& scenes = member_or_empty(document, "scenes");
    if (scenes.empty())
        malformed("has no scene");
    const std::uint64_t shown = number_or(document, "scene", 0);
    if (shown >= scenes.size())
        malformed("its scene does not exist");
    for (const json& root : member_or_empty(scenes[shown], "nodes"))
        tree.roots.push_back(static_cast<std::uint32_t>(index_of(root, nodes.size(), "node")));
    check_trees(tree);
    return tree;
}

} // namespace abut
