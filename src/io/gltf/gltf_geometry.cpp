#include "io/gltf/gltf_geometry.h"

#include "io/file/companion_file.h"
#include "io/file/fault.h"
#include "io/gltf/gltf_json.h"

#include <algorithm>
#include <array>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kNone = GlbDocument::kNone;

[[noreturn]] void does_not_exist(const char* what, std::uint32_t index) {
    malformed(std::string("its JSON refers to ") + what + " " +
              (index == kNone ? "" : std::to_string(index)) + ", which does not exist");
}

} // namespace

GltfGeometry::GltfGeometry(const std::string& path, const RandomAccessFile& file,
                           const GlbDocument& document, const SourceOptions& options)
    : file_(file), document_(document) {
    for (const std::string& reference : document.companions) {
        const std::string companion =
            companion_path(path, reference, options.read.allow_outside_files);
        try {
            companions_.push_back(std::make_unique<RandomAccessFile>(companion, options.watch));
        } catch (const Fault& fault) {
            malformed("its buffer " + reference.substr(0, 200) + ": " + fault.what());
        }
    }
    for (const GlbDocument::Buffer& buffer : document.buffers)
        if (buffer.place == GlbDocument::Buffer::Place::companion &&
            buffer.bytes > companions_[buffer.at]->size())
            malformed("its buffer " + document.companions[buffer.at].substr(0, 200) +
                      " is truncated: " + std::to_string(companions_[buffer.at]->size()) + " of " +
                      std::to_string(buffer.bytes) + " bytes");
    decode(path, options);
}

bool GltfGeometry::is_decoded_view(const GlbDocument::View& view) const {
    // A view may have an uncompressed form for readers that know none other.
    return view.compressed != kNone &&
           (document_.requires_meshopt || view.buffer >= document_.buffers.size() ||
            document_.buffers[view.buffer].place == GlbDocument::Buffer::Place::none);
}

bool GltfGeometry::is_decoded_primitive(const GlbDocument::Primitive& primitive) const {
    return primitive.draco != kNone &&
           (document_.requires_draco || accessor(primitive.position).view == kNone);
}

const GlbDocument::Accessor& GltfGeometry::accessor(std::uint32_t index) const {
    if (index >= document_.accessors.size())
        does_not_exist("accessor", index);
    return document_.accessors[index];
}

const GlbDocument::View& GltfGeometry::view(std::uint32_t index) const {
    if (index >= document_.views.size())
        does_not_exist("buffer view", index);
    return document_.views[index];
}

GltfGeometry::Place GltfGeometry::place(std::uint32_t buffer_index, std::uint64_t offset,
                                        std::uint64_t bytes) const {
    using Where = GlbDocument::Buffer::Place;
    if (buffer_index >= document_.buffers.size())
        does_not_exist("buffer", buffer_index);
    const GlbDocument::Buffer& buffer = document_.buffers[buffer_index];
    if (std::max(offset, bytes) > kLargestGltfSize)
        malformed("a buffer view has an impossible size");
    if (offset + bytes > buffer.bytes)
        malformed("a buffer view reaches beyond its buffer");
    switch (buffer.place) {
    case Where::binary:
        return {&file_, nullptr, document_.binary_at + offset};
    case Where::data:
        return {nullptr, &document_.spool, buffer.at + offset};
    case Where::companion:
        return {companions_[buffer.at].get(), nullptr, offset};
    default:
        malformed("buffer " + std::to_string(buffer_index) + " has no content");
    }
}

GltfElements GltfGeometry::elements(std::uint32_t view_index, std::uint64_t offset,
                                    std::uint64_t count, std::uint16_t component,
                                    std::uint8_t components) const {
    const std::uint64_t size = component_bytes(component) * components;
    GltfElements result;
    result.count = count;
    result.stride = size;
    result.component = component;
    result.components = components;
    if (std::max(count, offset) > kLargestGltfSize)
        malformed("an accessor has an impossible size");
    if (view_index == kNone)
        return result;
    const GlbDocument::View& from = view(view_index);
    std::uint64_t bytes = from.bytes;
    Place where;
    if (is_decoded_view(from)) {
        const GlbDocument::Compressed& compressed = document_.compressed[from.compressed];
        bytes = compressed.count * compressed.stride;
        where = {nullptr, decoded_.get(), decoded_view_[from.compressed]};
        if (compressed.mode == GlbDocument::Compressed::Mode::attributes)
            result.stride = compressed.stride;
    } else {
        where = place(from.buffer, from.offset, from.bytes);
        if (from.stride != 0)
            result.stride = from.stride;
    }
    if (result.stride < size)
        malformed("a buffer view has a stride below the size of its elements");
    if (count > 0 && offset + result.stride * (count - 1) + size > bytes)
        malformed("an accessor reaches beyond its buffer view");
    result.file = where.file;
    result.temporary = where.temporary;
    result.at = where.at + offset;
    return result;
}

GltfElements GltfGeometry::elements(const GlbDocument::Accessor& accessor) const {
    GltfElements result = elements(accessor.view, accessor.offset, accessor.count,
                                   accessor.component, accessor.components);
    result.is_normalized = accessor.is_normalized;
    if (accessor.sparse == kNone)
        return result;
    const GlbDocument::Sparse& sparse = document_.sparse[accessor.sparse];
    const auto place = [&](std::uint32_t view_index, std::uint64_t offset, std::uint16_t component,
                           std::uint8_t components) {
        (void)view(view_index);
        return elements(view_index, offset, sparse.count, component, components);
    };
    std::array<GltfElements, 2> stored{
        place(sparse.index_view, sparse.index_offset, sparse.index_component, 1),
        place(sparse.value_view, sparse.value_offset, accessor.component, accessor.components)};
    if (!is_unsigned_integer(sparse.index_component))
        malformed("the indices of a sparse accessor are not unsigned integers");
    stored[1].is_normalized = accessor.is_normalized;
    check_sparse_indices(stored[0], accessor.count);
    result.sparse = std::make_shared<const std::array<GltfElements, 2>>(std::move(stored));
    return result;
}

GltfElements GltfGeometry::values(std::uint32_t index, std::uint8_t components) const {
    const GlbDocument::Accessor& found = accessor(index);
    if (found.components != components)
        malformed("accessor " + std::to_string(index) + " does not have " +
                  std::to_string(components) + " components");
    return elements(found);
}

GltfElements GltfGeometry::positions(const GlbDocument::Primitive& primitive) const {
    const GlbDocument::Accessor& found = accessor(primitive.position);
    if (found.components != 3)
        malformed("positions are not of type VEC3");
    (void)component_bytes(found.component);
    if (found.component == kUnsignedInt)
        throw Fault(ErrorCode::unsupported, "positions are neither floats nor short integers");
    if (!is_decoded_primitive(primitive))
        return elements(found);
    GltfElements result;
    result.temporary = decoded_.get();
    result.at = decoded_draco_[primitive.draco].positions;
    result.count = found.count;
    result.stride = 3 * component_bytes(found.component);
    result.component = found.component;
    result.components = 3;
    result.is_normalized = found.is_normalized;
    return result;
}

std::optional<GltfElements> GltfGeometry::indices(const GlbDocument::Primitive& primitive) const {
    if (primitive.indices == kNone)
        return std::nullopt;
    const GlbDocument::Accessor& found = accessor(primitive.indices);
    if (found.components != 1)
        malformed("indices are not of type SCALAR");
    if (!is_decoded_primitive(primitive)) {
        GltfElements result = elements(found);
        if (!is_unsigned_integer(found.component))
            malformed("indices are not unsigned integers");
        return result;
    }
    GltfElements result;
    result.temporary = decoded_.get();
    result.at = decoded_draco_[primitive.draco].corners;
    result.count = found.count;
    result.stride = 4;
    result.component = kUnsignedInt;
    result.components = 1;
    return result;
}

} // namespace abut
