#include "io/glb_document.h"

#include "io/fault.h"
#include "io/gltf_json.h"

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

/// A part of a file as a stream, through a small buffer.
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

/// The JSON chunk and the first binary one; what else the isolated reader makes of a file's frame
/// is left to it.
std::array<Chunk, 2> find_chunks(const RandomAccessFile& file) {
    if (file.size() < kGlbHeaderBytes + kChunkHeaderBytes)
        throw NotStreamable();
    const auto [magic, version, length] = file.value<std::array<std::uint32_t, 3>>(0);
    if (magic != kGlbMagic || version != 2)
        throw NotStreamable();
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
        if (number > 1 || kind != (number == 0 ? kJsonChunk : kBinaryChunk))
            throw NotStreamable();
        chunks.at(number) = {at, size};
        at += size;
    }
    return chunks;
}

std::uint32_t index_or_none(const json& object, const char* key) {
    const std::uint64_t index = number_or(object, key, GlbDocument::kNone);
    if (index > GlbDocument::kNone)
        throw NotStreamable();
    return static_cast<std::uint32_t>(index);
}

/// Takes the elements of the JSON's lists as they end, and lets go of them.
class DocumentReader {
public:
    explicit DocumentReader(GlbDocument& document) : document_(document) {}

    /// As nlohmann::json's parser calls it. False: the element is not kept.
    bool operator()(int depth, json::parse_event_t event, json& parsed) {
        using Event = json::parse_event_t;
        if (depth == 1 && event == Event::key) {
            section_ = parsed.get<std::string>();
            // Of two lists with one name the last would count.
            if (!sections_.insert(section_).second)
                throw NotStreamable();
        }
        if (depth == 2 && event == Event::object_end && take(parsed))
            return false;
        return true;
    }

    /// In          rest: what is left of the document.
    void finish(const json& rest) {
        for (const char* list : {"nodes", "meshes", "accessors", "bufferViews", "buffers"})
            if (const auto found = rest.find(list); found != rest.end() && !found->empty())
                throw NotStreamable(); // elements that are no objects
        if (!rest.contains("asset") ||
            text_or_empty(rest["asset"], "version").rfind("2.", 0) != 0 || rest.contains("skins"))
            throw NotStreamable();
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            for (const json& extension : member_or_empty(rest, list))
                if (!extension.is_string() ||
                    !is_harmless_gltf_extension(extension.get<std::string>()))
                    throw NotStreamable();
        const json& scenes = member_or_empty(rest, "scenes");
        const std::uint64_t shown = number_or(rest, "scene", scenes.size());
        if (!scenes.is_array() || shown >= scenes.size() || buffers_ > 1)
            throw NotStreamable();
        for (const json& root : member_or_empty(scenes[shown], "nodes"))
            document_.roots.push_back(reference(root));
        document_.nodes.finish();
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
        else
            // Materials and the like hold nothing that is asked for.
            return section_ != "scenes" && section_ != "asset";
        return true;
    }

    static std::uint32_t reference(const json& value) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= GlbDocument::kNone)
            throw NotStreamable();
        return value.get<std::uint32_t>();
    }

    void take_node(const json& node) {
        Part part;
        part.id = text_or_empty(node, "name");
        if (const auto extras = node.find("extras"); extras != node.end()) {
            part.name = text_or_empty(*extras, "name");
            part.type = text_or_empty(*extras, "type");
        }
        // Assimp cuts long names and has a use of its own for brackets; then its tree counts.
        constexpr std::size_t kLongestName = 1000;
        if (part.id.size() > kLongestName || part.name.size() > kLongestName ||
            part.type.size() > kLongestName || part.id.starts_with('<') || node.contains("skin") ||
            node.contains("extensions"))
            throw NotStreamable();
        part.mesh = index_or_none(node, "mesh");
        part.world_from_mesh = gltf_transform(node);
        for (const json& child : member_or_empty(node, "children"))
            document_.children.push_back(reference(child));
        document_.first_child.push_back(document_.children.size());
        document_.nodes.append(part);
    }

    void take_mesh(const json& mesh) {
        for (const json& primitive : mesh.at("primitives")) {
            // Points, lines, strips and fans, morphs and compressed geometry.
            if (number_or(primitive, "mode", 4) != 4 || primitive.contains("targets") ||
                primitive.contains("extensions"))
                throw NotStreamable();
            document_.primitives.push_back({index_or_none(primitive.at("attributes"), "POSITION"),
                                            index_or_none(primitive, "indices")});
        }
        document_.first_primitive.push_back(document_.primitives.size());
    }

    void take_accessor(const json& accessor) {
        if (accessor.contains("sparse"))
            throw NotStreamable();
        const std::string type = text_or_empty(accessor, "type");
        document_.accessors.push_back(
            {number_or(accessor, "byteOffset", 0), number_or(accessor, "count", 0),
             index_or_none(accessor, "bufferView"),
             static_cast<std::uint16_t>(
                 std::min<std::uint64_t>(number_or(accessor, "componentType", 0), 0xffff)),
             type == "VEC3", type == "SCALAR"});
    }

    void take_view(const json& view) {
        const std::uint64_t stride = number_or(view, "byteStride", 0);
        if (stride > 252 || view.contains("extensions"))
            throw NotStreamable();
        document_.views.push_back(
            {number_or(view, "byteOffset", 0), number_or(view, "byteLength", 0),
             static_cast<std::uint32_t>(stride), number_or(view, "buffer", 1) == 0});
    }

    void take_buffer(const json& buffer) {
        if (buffer.contains("uri") || buffer.contains("extensions") ||
            number_or(buffer, "byteLength", 0) > document_.binary_bytes)
            throw NotStreamable();
        ++buffers_;
        document_.binary_bytes = number_or(buffer, "byteLength", 0);
    }

    GlbDocument& document_;
    std::string section_;
    std::set<std::string> sections_;
    std::size_t buffers_ = 0;
};

} // namespace

void read_glb_document(const RandomAccessFile& file, GlbDocument& document) {
    const auto [text, binary] = find_chunks(file);
    document.binary_at = binary.at;
    document.binary_bytes = binary.bytes;
    ChunkBuffer buffer(file, text.at, text.bytes);
    DocumentReader reader(document);
    try {
        const json rest =
            json::parse(std::istreambuf_iterator<char>(&buffer), std::istreambuf_iterator<char>(),
                        [&](int depth, json::parse_event_t event, json& parsed) {
                            return reader(depth, event, parsed);
                        });
        if (!rest.is_object())
            throw NotStreamable();
        reader.finish(rest);
    } catch (const json::exception&) {
        throw NotStreamable();
    }
}

} // namespace abut
