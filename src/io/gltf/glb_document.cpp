#include "io/gltf/glb_document.h"

#include "io/file/fault.h"
#include "io/gltf/gltf_extras.h"
#include "io/gltf/gltf_json.h"
#include "io/gltf/gltf_material.h"
#include "io/gltf/gltf_uri.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <streambuf>
#include <string_view>

namespace abut {

namespace {

using nlohmann::json;

/// A section of a file as a stream with a small buffer.
class ChunkBuffer : public std::streambuf {
public:
    ChunkBuffer(const RandomAccessFile& file, std::uint64_t at, std::uint64_t size)
        : file_(file), at_(at), left_(size) {}

protected:
    int_type underflow() override {
        const std::size_t count = std::min<std::uint64_t>(buffer_.size(), left_);
        if (count == 0)
            return traits_type::eof();
        file_.read(at_, std::as_writable_bytes(std::span(buffer_).first(count)));
        at_ += count;
        left_ -= count;
        setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
        return traits_type::to_int_type(buffer_.front());
    }

private:
    const RandomAccessFile& file_;
    std::uint64_t at_, left_;
    std::array<char, 65536> buffer_{};
};

struct Chunk {
    std::uint64_t at = 0, bytes = 0;
};

/// Finds the JSON chunk, which is the first, and the first binary chunk.
std::array<Chunk, 2> find_chunks(const RandomAccessFile& file) {
    if (file.size() < kGlbHeaderBytes + kChunkHeaderBytes)
        malformed("is too short for a GLB file");
    const auto [magic, version, length] = file.value<std::array<std::uint32_t, 3>>(0);
    if (magic != kGlbMagic)
        malformed("is not a GLB file");
    if (version != 2)
        throw Fault(ErrorCode::unsupported,
                    "is glTF version " + std::to_string(version) + "; only version 2 is supported");
    if (length > file.size())
        malformed("is truncated: " + std::to_string(file.size()) + " of " + std::to_string(length) +
                  " bytes");
    std::array<Chunk, 2> chunks;
    std::size_t number = 0;
    for (std::uint64_t at = kGlbHeaderBytes; at + kChunkHeaderBytes <= length; ++number) {
        const auto [size, kind] = file.value<std::array<std::uint32_t, 2>>(at);
        at += kChunkHeaderBytes;
        if (size > length - at)
            malformed("is truncated: a chunk reaches beyond its end");
        if (number == 0 && kind != kJsonChunk)
            malformed("its first chunk is not JSON");
        // The format requires that other kinds of chunks are ignored.
        Chunk& chunk = chunks.at(number == 0 ? 0 : 1);
        if (chunk.at == 0 && (number == 0 || kind == kBinaryChunk))
            chunk = {at, size};
        at += size;
    }
    return chunks;
}

std::uint32_t index_or_none(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end())
        return GlbDocument::kNone;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() >= GlbDocument::kNone)
        malformed(std::string("its JSON gives a wrong number for ") + key);
    return found->get<std::uint32_t>();
}

/// Returns an extension of an element; null if it has none of that name.
const json* extension_of(const json& element, std::string_view name) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end())
        return nullptr;
    const auto found = extensions->find(name);
    return found == extensions->end() || !found->is_object() ? nullptr : &*found;
}

/// Returns the meshoptimizer extension, which was standardised under a second name.
const json* meshopt_of(const json& element) {
    const json* const found = extension_of(element, kMeshoptExtensions[0]);
    return found != nullptr ? found : extension_of(element, kMeshoptExtensions[1]);
}

/// Returns the index of a word in a list.
template <typename Value, std::size_t count>
Value named(const std::string& word, const std::array<const char*, count>& names,
            const char* what) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end())
        throw Fault(ErrorCode::unsupported,
                    std::string("a buffer view has the ") + what + " " + word.substr(0, 40));
    return static_cast<Value>(found - names.begin());
}

/// Stores the elements of the JSON's lists as they are parsed, and discards their JSON.
class DocumentReader {
public:
    DocumentReader(GlbDocument& document, bool is_text) : document_(document), is_text_(is_text) {}

    /// Callback of nlohmann::json's parser. False: the element is not kept.
    bool operator()(int depth, json::parse_event_t event, json& parsed) {
        using Event = json::parse_event_t;
        if (depth == 1 && event == Event::key) {
            section_ = parsed.get<std::string>();
            // Parsers differ in which of two lists of the same name they use.
            if (!sections_.insert(section_).second)
                malformed("its JSON has two lists " + section_.substr(0, 40));
        }
        if (depth == 2 && event == Event::object_end && take(parsed))
            return false;
        return true;
    }

    /// In          rest: the JSON that was kept.
    void finish(const json& rest) {
        if (!rest.is_object() || !rest.contains("asset"))
            malformed("is not a glTF file");
        if (text_or_empty(rest["asset"], "version").rfind("2.", 0) != 0)
            throw Fault(ErrorCode::unsupported, "is not glTF 2");
        for (const char* list : {"nodes", "meshes", "accessors", "bufferViews", "buffers"})
            if (const auto found = rest.find(list);
                found != rest.end() && (!found->is_array() || !found->empty()))
                malformed(std::string("its JSON has ") + list + " that are not a list of objects");
        for (const json& extension : member_or_empty(rest, "extensionsRequired"))
            require(extension.get<std::string>());
        const json& scenes = member_or_empty(rest, "scenes");
        if (!scenes.is_array() || scenes.empty())
            malformed("has no scene");
        const std::uint64_t shown = number_or(rest, "scene", 0);
        if (shown >= scenes.size())
            malformed("its scene does not exist");
        for (const json& root : member_or_empty(scenes[shown], "nodes"))
            document_.roots.push_back(reference(root));
        document_.nodes.finish();
        // Elements that are not objects were not counted, so the others' indices are not known.
        const json& materials = member_or_empty(rest, "materials");
        if (!materials.is_array() || !materials.empty())
            document_.materials.clear();
    }

private:
    bool take(const json& element) {
        if (section_ == "nodes")
            take_node(element);
        else if (section_ == "meshes")
            take_mesh(element);
        else if (section_ == "accessors")
            take_accessor(element);
        else if (section_ == "bufferViews")
            take_view(element);
        else if (section_ == "buffers")
            take_buffer(element);
        else if (section_ == "materials")
            document_.materials.push_back(colour_of_material(element));
        else
            // Cameras and the like are not needed.
            return section_ != "scenes" && section_ != "asset";
        return true;
    }

    void require(const std::string& name) {
        document_.requires_draco = document_.requires_draco || name == kDracoExtension;
        document_.requires_meshopt = document_.requires_meshopt || name == kMeshoptExtensions[0] ||
                                     name == kMeshoptExtensions[1];
        if (!is_known_gltf_extension(name))
            throw Fault(ErrorCode::unsupported, "needs the glTF extension " + name.substr(0, 100));
    }

    static std::uint32_t reference(const json& value) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= GlbDocument::kNone)
            malformed("its JSON refers to node " + value.dump() + ", which does not exist");
        return value.get<std::uint32_t>();
    }

    void take_node(const json& node) {
        Part part;
        std::vector<PartProperty> properties;
        part.id = text_or_empty(node, "name");
        if (const auto extras = node.find("extras"); extras != node.end()) {
            part.name = text_or_empty(*extras, "name");
            part.type = text_or_empty(*extras, "type");
            properties = properties_of_extras(*extras);
        }
        part.mesh = index_or_none(node, "mesh");
        part.world_from_mesh = gltf_transform(node);
        if (const json* const instancing = extension_of(node, kInstancingExtension)) {
            const json& attributes = instancing->at("attributes");
            const auto number = static_cast<std::uint32_t>(document_.nodes.size());
            document_.instances.push_back({number, index_or_none(attributes, "TRANSLATION"),
                                           index_or_none(attributes, "ROTATION"),
                                           index_or_none(attributes, "SCALE")});
        }
        for (const json& child : member_or_empty(node, "children"))
            document_.children.push_back(reference(child));
        document_.first_child.push_back(document_.children.size());
        document_.nodes.append(part, properties);
    }

    void take_mesh(const json& mesh) {
        for (const json& primitive : mesh.at("primitives")) {
            GlbDocument::Primitive result;
            using Mode = GlbDocument::Primitive::Mode;
            const std::uint64_t mode = number_or(primitive, "mode", 4);
            result.mode = mode >= 4 && mode <= 6 ? static_cast<Mode>(mode) : Mode::other;
            result.position = index_or_none(primitive.at("attributes"), "POSITION");
            result.indices = index_or_none(primitive, "indices");
            result.material = material_of(primitive);
            if (result.mode != Mode::other && result.position == GlbDocument::kNone)
                malformed("a primitive has no positions");
            if (const json* const draco = extension_of(primitive, kDracoExtension)) {
                result.draco = static_cast<std::uint32_t>(document_.draco.size());
                document_.draco.push_back({index_or_none(*draco, "bufferView"),
                                           index_or_none(draco->at("attributes"), "POSITION")});
            }
            document_.primitives.push_back(result);
        }
        document_.first_primitive.push_back(document_.primitives.size());
    }

    /// A wrong index is no fault, because a model is useful without its colours.
    static std::uint32_t material_of(const json& primitive) {
        const auto found = primitive.find("material");
        return found != primitive.end() && found->is_number_unsigned()
                   ? static_cast<std::uint32_t>(
                         std::min<std::uint64_t>(found->get<std::uint64_t>(), GlbDocument::kNone))
                   : GlbDocument::kNone;
    }

    void take_accessor(const json& accessor) {
        GlbDocument::Accessor result;
        result.offset = number_or(accessor, "byteOffset", 0);
        result.count = number_or(accessor, "count", 0);
        result.view = index_or_none(accessor, "bufferView");
        result.component = component(accessor);
        constexpr std::array<std::string_view, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
        const auto* const type =
            std::find(kTypes.begin(), kTypes.end(), text_or_empty(accessor, "type"));
        if (type != kTypes.end())
            result.components = static_cast<std::uint8_t>(type - kTypes.begin() + 1);
        const auto normalized = accessor.find("normalized");
        result.is_normalized = normalized != accessor.end() && normalized->get<bool>();
        if (const auto sparse = accessor.find("sparse"); sparse != accessor.end()) {
            const json& indices = sparse->at("indices");
            const json& values = sparse->at("values");
            result.sparse = static_cast<std::uint32_t>(document_.sparse.size());
            document_.sparse.push_back(
                {number_or(*sparse, "count", 0), number_or(indices, "byteOffset", 0),
                 number_or(values, "byteOffset", 0), index_or_none(indices, "bufferView"),
                 index_or_none(values, "bufferView"), component(indices)});
        }
        document_.accessors.push_back(result);
    }

    static std::uint16_t component(const json& object) {
        return static_cast<std::uint16_t>(
            std::min<std::uint64_t>(number_or(object, "componentType", 0), 0xffff));
    }

    void take_view(const json& view) {
        GlbDocument::View result;
        result.buffer = index_or_none(view, "buffer");
        result.offset = number_or(view, "byteOffset", 0);
        result.bytes = number_or(view, "byteLength", 0);
        result.stride = stride(view);
        if (const json* const meshopt = meshopt_of(view)) {
            GlbDocument::Compressed compressed;
            compressed.buffer = index_or_none(*meshopt, "buffer");
            compressed.offset = number_or(*meshopt, "byteOffset", 0);
            compressed.bytes = number_or(*meshopt, "byteLength", 0);
            compressed.stride = stride(*meshopt);
            compressed.count = number_or(*meshopt, "count", 0);
            compressed.mode = named<GlbDocument::Compressed::Mode>(
                text_or_empty(*meshopt, "mode"), std::array{"ATTRIBUTES", "TRIANGLES", "INDICES"},
                "compression mode");
            if (meshopt->contains("filter"))
                compressed.filter = named<GlbDocument::Compressed::Filter>(
                    text_or_empty(*meshopt, "filter"),
                    std::array{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"},
                    "filter");
            result.compressed = static_cast<std::uint32_t>(document_.compressed.size());
            document_.compressed.push_back(compressed);
        }
        document_.views.push_back(result);
    }

    static std::uint32_t stride(const json& view) {
        constexpr std::uint64_t kLargest = 256;
        const std::uint64_t value = number_or(view, "byteStride", 0);
        if (value > kLargest)
            malformed("a buffer view has an impossible size");
        return static_cast<std::uint32_t>(value);
    }

    void take_buffer(const json& buffer) {
        using Place = GlbDocument::Buffer::Place;
        GlbDocument::Buffer result;
        result.bytes = number_or(buffer, "byteLength", 0);
        const json* const meshopt = meshopt_of(buffer);
        const auto uri = buffer.find("uri");
        if (uri != buffer.end()) {
            const auto& text = uri->get_ref<const std::string&>();
            if (const auto bytes = bytes_of_data_uri(text)) {
                if (bytes->size() < result.bytes)
                    malformed("a data: URI holds " + std::to_string(bytes->size()) + " of " +
                              std::to_string(result.bytes) + " bytes");
                result.place = Place::data;
                result.at = document_.spooled;
                document_.spool.write(document_.spooled, *bytes);
                document_.spooled += bytes->size();
            } else {
                result.place = Place::companion;
                result.at = document_.companions.size();
                document_.companions.push_back(path_of_uri(text));
            }
        } else if (!is_text_ && document_.buffers.empty() &&
                   (meshopt == nullptr || !meshopt->value("fallback", false))) {
            if (result.bytes > document_.binary_bytes)
                malformed("its buffer is longer than the file's binary part");
            result.place = Place::binary;
        }
        document_.buffers.push_back(result);
    }

    GlbDocument& document_;
    bool is_text_;
    std::string section_;
    std::set<std::string> sections_;
};

} // namespace

void read_glb_document(const RandomAccessFile& file, bool is_text, GlbDocument& document) {
    const auto [text, binary] =
        is_text ? std::array<Chunk, 2>{{{0, file.size()}, {}}} : find_chunks(file);
    document.binary_at = binary.at;
    document.binary_bytes = binary.bytes;
    ChunkBuffer buffer(file, text.at, text.bytes);
    DocumentReader reader(document, is_text);
    try {
        const json rest =
            json::parse(std::istreambuf_iterator<char>(&buffer), std::istreambuf_iterator<char>(),
                        [&](int depth, json::parse_event_t event, json& parsed) {
                            return reader(depth, event, parsed);
                        });
        reader.finish(rest);
    } catch (const json::parse_error& error) {
        malformed("its JSON is truncated or malformed at byte " + std::to_string(error.byte));
    } catch (const json::exception& error) {
        // "[json.exception.type_error.302] type must be string, but is number"
        const std::string_view what = error.what();
        malformed("its JSON is not valid glTF: " +
                  std::string(what.substr(std::min(what.find("] ") + 2, what.size()))));
    }
}

} // namespace abut
