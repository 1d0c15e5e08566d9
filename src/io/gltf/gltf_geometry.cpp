#include "io/gltf/gltf_geometry.h"

#include "io/file/companion_file.h"
#include "io/file/fault.h"
#include "io/gltf/gltf_json.h"
#include "io/process/decode_geometry.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace abut {

namespace {

constexpr std::uint64_t kLargest = std::uint64_t{1} << 40;
constexpr std::uint32_t kNone = GlbDocument::kNone;
constexpr std::size_t kChunkBytes = std::size_t{1} << 18;

std::uint64_t component_bytes(std::uint16_t component) {
    switch (component) {
    case kByte:
    case kUnsignedByte:
        return 1;
    case kShort:
    case kUnsignedShort:
        return 2;
    case kUnsignedInt:
    case kFloat:
        return 4;
    default:
        malformed("an accessor has an unknown component type");
    }
}

[[noreturn]] void does_not_exist(const char* what, std::uint32_t index) {
    malformed(std::string("its JSON refers to ") + what + " " +
              (index == kNone ? "" : std::to_string(index)) + ", which does not exist");
}

void read_bytes(const GltfGeometry::Elements& elements, std::uint64_t at,
                std::span<std::byte> bytes) {
    if (elements.file != nullptr)
        elements.file->read(at, bytes);
    else if (elements.temporary != nullptr)
        elements.temporary->read(at, bytes);
    else
        std::fill(bytes.begin(), bytes.end(), std::byte{});
}

/// Converts a normalised integer to a number [glTF 2.0, 3.6.2.2].
template <typename Component>
double value_of(Component component, bool is_normalized) {
    if constexpr (std::is_integral_v<Component>)
        if (is_normalized)
            return std::max(static_cast<double>(component) /
                                static_cast<double>(std::numeric_limits<Component>::max()),
                            -1.0);
    return static_cast<double>(component);
}

template <typename Component, typename Value>
void convert_from(const GltfGeometry::Elements& elements, std::span<const std::byte> bytes,
                  std::span<Value> to) {
    const std::byte* element = bytes.data();
    for (std::size_t i = 0; i < to.size(); i += elements.components, element += elements.stride)
        for (std::size_t k = 0; k < elements.components; ++k) {
            Component component;
            std::memcpy(&component, element + k * sizeof component, sizeof component);
            if constexpr (std::is_floating_point_v<Value>)
                to[i + k] = static_cast<Value>(value_of(component, elements.is_normalized));
            else
                to[i + k] = static_cast<Value>(component);
        }
}

template <typename Value>
void convert(const GltfGeometry::Elements& elements, std::span<const std::byte> bytes,
             std::span<Value> to) {
    switch (elements.component) {
    case kUnsignedByte:
        return convert_from<std::uint8_t>(elements, bytes, to);
    case kUnsignedShort:
        return convert_from<std::uint16_t>(elements, bytes, to);
    case kUnsignedInt:
        return convert_from<std::uint32_t>(elements, bytes, to);
    default:
        break;
    }
    // Indices never have these types.
    if constexpr (std::is_floating_point_v<Value>) {
        if (elements.component == kByte)
            convert_from<std::int8_t>(elements, bytes, to);
        else if (elements.component == kShort)
            convert_from<std::int16_t>(elements, bytes, to);
        else
            convert_from<float>(elements, bytes, to);
    }
}

/// Calls `take` for portions of the elements: the first element, and its numbers' place in `to`.
template <typename Value, typename Take>
void in_pieces(const GltfGeometry::Elements& elements, std::uint64_t first, std::span<Value> to,
               const Take& take) {
    const std::uint64_t count = to.size() / elements.components;
    const std::uint64_t most = std::max<std::uint64_t>(kChunkBytes / elements.stride, 1);
    for (std::uint64_t i = 0; i < count; i += most) {
        const std::uint64_t piece = std::min(most, count - i);
        take(first + i, to.subspan(i * elements.components, piece * elements.components));
    }
}

template <typename Value>
void read_dense(const GltfGeometry::Elements& elements, std::uint64_t first, std::span<Value> to) {
    const std::uint64_t size = elements.components * component_bytes(elements.component);
    std::vector<std::byte> bytes;
    in_pieces(elements, first, to, [&](std::uint64_t start, std::span<Value> piece) {
        const std::uint64_t count = piece.size() / elements.components;
        bytes.resize(elements.stride * (count - 1) + size);
        read_bytes(elements, elements.at + start * elements.stride, bytes);
        convert(elements, bytes, piece);
    });
}

std::uint32_t index_at(const GltfGeometry::Elements& indices, std::uint64_t number) {
    std::uint32_t index = 0;
    read_dense(indices, number, std::span(&index, 1));
    return index;
}

/// Overwrites elements [first, first + count of `to`) with those in sparse storage.
template <typename Value>
void read_sparse(const GltfGeometry::Elements& elements, std::uint64_t first, std::span<Value> to) {
    const auto& [indices, values] = *elements.sparse;
    const std::uint64_t end = first + to.size() / elements.components;
    // The indices ascend; check_sparse ensures it.
    std::uint64_t low = 0;
    for (std::uint64_t high = indices.count; low < high;) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (index_at(indices, middle) < first)
            low = middle + 1;
        else
            high = middle;
    }
    constexpr std::uint64_t kPiece = 4096;
    std::vector<std::uint32_t> where;
    std::vector<Value> what;
    while (low < indices.count) {
        where.resize(std::min(kPiece, indices.count - low));
        read_dense(indices, low, std::span(where));
        what.resize(where.size() * elements.components);
        read_dense(values, low, std::span(what));
        for (std::size_t i = 0; i < where.size(); ++i) {
            if (where[i] < first || where[i] >= end)
                return;
            std::copy_n(what.begin() + static_cast<std::ptrdiff_t>(i * elements.components),
                        elements.components,
                        to.begin() +
                            static_cast<std::ptrdiff_t>((where[i] - first) * elements.components));
        }
        low += where.size();
    }
}

template <typename Value>
void read_any(const GltfGeometry::Elements& elements, std::uint64_t first, std::span<Value> to) {
    read_dense(elements, first, to);
    if (elements.sparse != nullptr)
        read_sparse(elements, first, to);
}

void check_sparse(const GltfGeometry::Elements& indices, std::uint64_t elements) {
    constexpr std::uint64_t kPiece = 65536;
    std::vector<std::uint32_t> piece;
    std::uint64_t least = 0;
    for (std::uint64_t i = 0; i < indices.count; i += kPiece) {
        piece.resize(std::min(kPiece, indices.count - i));
        read_dense(indices, i, std::span(piece));
        for (const std::uint32_t index : piece) {
            if (index < least || index >= elements)
                malformed("the indices of a sparse accessor do not ascend, or exceed its count");
            least = std::uint64_t{index} + 1;
        }
    }
}

/// Returns a lower bound of the compressed size of some elements, less a few bytes for the stream's
/// frame. A larger count is refused before memory is allocated for it.
///
/// Source      EXT_meshopt_compression: two bits for 16 equal bytes, one byte for a triangle, one
///             byte for an index.
std::uint64_t least_bytes(const GlbDocument::Compressed& compressed) {
    using Mode = GlbDocument::Compressed::Mode;
    return compressed.mode == Mode::attributes  ? compressed.count * compressed.stride / 64
           : compressed.mode == Mode::triangles ? compressed.count / 3
                                                : compressed.count;
}

decode_request::Job job_of(const GlbDocument::Compressed& compressed) {
    using Mode = GlbDocument::Compressed::Mode;
    using Filter = GlbDocument::Compressed::Filter;
    const std::uint32_t stride = compressed.stride;
    const bool is_index = compressed.mode != Mode::attributes;
    const bool fits = is_index ? stride == 2 || stride == 4 : stride > 0 && stride % 4 == 0;
    const bool filter_fits =
        compressed.filter == Filter::none ||
        (!is_index && (compressed.filter == Filter::octahedral   ? stride == 4 || stride == 8
                       : compressed.filter == Filter::quaternion ? stride == 8
                       : compressed.filter == Filter::color      ? false // never a position
                                                                 : true));
    if (!fits || !filter_fits || compressed.count > kLargest ||
        least_bytes(compressed) > compressed.bytes ||
        (compressed.mode == Mode::triangles && compressed.count % 3 != 0))
        malformed("a compressed buffer view has an impossible size");
    decode_request::Job job;
    job.kind = compressed.mode == Mode::attributes  ? decode_request::Kind::meshopt_attributes
               : compressed.mode == Mode::triangles ? decode_request::Kind::meshopt_triangles
                                                    : decode_request::Kind::meshopt_indices;
    job.filter = static_cast<decode_request::Filter>(compressed.filter);
    job.stride = stride;
    job.count = compressed.count;
    return job;
}

/// Refuses attributes in version 1 of the codec, which only KHR_meshopt_compression allows.
///
/// In          input: the compressed bytes, at least one.
void check_codec(const DecodeJobs::Input& input) {
    constexpr std::byte kVersionOne{0xa1};
    std::byte header{};
    input(0, std::span(&header, 1));
    if (header == kVersionOne)
        throw Fault(ErrorCode::unsupported, "is compressed by version 1 of meshoptimizer's vertex "
                                            "codec; only version 0 is supported");
}

} // namespace

/// A place of bytes: in a file or in a temporary file.
struct GltfGeometry::Place {
    const RandomAccessFile* file = nullptr;
    const TemporaryFile* temporary = nullptr;
    std::uint64_t at = 0;
};

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
    // A view may also have an uncompressed form, for readers without the extension.
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
    if (std::max(offset, bytes) > kLargest)
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

GltfGeometry::Elements GltfGeometry::elements(std::uint32_t view_index, std::uint64_t offset,
                                              std::uint64_t count, std::uint16_t component,
                                              std::uint8_t components) const {
    const std::uint64_t size = component_bytes(component) * components;
    Elements result;
    result.count = count;
    result.stride = size;
    result.component = component;
    result.components = components;
    if (std::max(count, offset) > kLargest)
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

GltfGeometry::Elements GltfGeometry::elements(const GlbDocument::Accessor& accessor) const {
    Elements result = elements(accessor.view, accessor.offset, accessor.count, accessor.component,
                               accessor.components);
    result.is_normalized = accessor.is_normalized;
    if (accessor.sparse == kNone)
        return result;
    const GlbDocument::Sparse& sparse = document_.sparse[accessor.sparse];
    const auto place = [&](std::uint32_t view_index, std::uint64_t offset, std::uint16_t component,
                           std::uint8_t components) {
        (void)view(view_index);
        return elements(view_index, offset, sparse.count, component, components);
    };
    std::array<Elements, 2> stored{
        place(sparse.index_view, sparse.index_offset, sparse.index_component, 1),
        place(sparse.value_view, sparse.value_offset, accessor.component, accessor.components)};
    if (sparse.index_component != kUnsignedByte && sparse.index_component != kUnsignedShort &&
        sparse.index_component != kUnsignedInt)
        malformed("the indices of a sparse accessor are not unsigned integers");
    stored[1].is_normalized = accessor.is_normalized;
    check_sparse(stored[0], accessor.count);
    result.sparse = std::make_shared<const std::array<Elements, 2>>(std::move(stored));
    return result;
}

GltfGeometry::Elements GltfGeometry::values(std::uint32_t index, std::uint8_t components) const {
    const GlbDocument::Accessor& found = accessor(index);
    if (found.components != components)
        malformed("accessor " + std::to_string(index) + " does not have " +
                  std::to_string(components) + " components");
    return elements(found);
}

GltfGeometry::Elements GltfGeometry::positions(const GlbDocument::Primitive& primitive) const {
    const GlbDocument::Accessor& found = accessor(primitive.position);
    if (found.components != 3)
        malformed("positions are not of type VEC3");
    (void)component_bytes(found.component);
    if (found.component == kUnsignedInt)
        throw Fault(ErrorCode::unsupported, "positions are neither floats nor short integers");
    if (!is_decoded_primitive(primitive))
        return elements(found);
    Elements result;
    result.temporary = decoded_.get();
    result.at = decoded_draco_[primitive.draco].positions;
    result.count = found.count;
    result.stride = 3 * component_bytes(found.component);
    result.component = found.component;
    result.components = 3;
    result.is_normalized = found.is_normalized;
    return result;
}

std::optional<GltfGeometry::Elements>
GltfGeometry::indices(const GlbDocument::Primitive& primitive) const {
    if (primitive.indices == kNone)
        return std::nullopt;
    const GlbDocument::Accessor& found = accessor(primitive.indices);
    if (found.components != 1)
        malformed("indices are not of type SCALAR");
    if (!is_decoded_primitive(primitive)) {
        Elements result = elements(found);
        if (found.component != kUnsignedByte && found.component != kUnsignedShort &&
            found.component != kUnsignedInt)
            malformed("indices are not unsigned integers");
        return result;
    }
    Elements result;
    result.temporary = decoded_.get();
    result.at = decoded_draco_[primitive.draco].corners;
    result.count = found.count;
    result.stride = 4;
    result.component = kUnsignedInt;
    result.components = 1;
    return result;
}

void GltfGeometry::read(const Elements& elements, std::uint64_t first, std::span<float> to) {
    read_any(elements, first, to);
}

void GltfGeometry::read(const Elements& elements, std::uint64_t first, std::span<double> to) {
    read_any(elements, first, to);
}

void GltfGeometry::read(const Elements& elements, std::uint64_t first,
                        std::span<std::uint32_t> to) {
    read_any(elements, first, to);
}

void GltfGeometry::decode(const std::string& path, const SourceOptions& options) {
    DecodeJobs jobs;
    constexpr std::uint64_t kNotAsked = std::numeric_limits<std::uint64_t>::max();
    std::vector<std::size_t> job_of_view(document_.compressed.size(), kNotAsked);
    std::vector<std::size_t> job_of_draco(document_.draco.size(), kNotAsked);
    const auto add = [&](decode_request::Job job, std::uint32_t buffer, std::uint64_t offset,
                         std::uint64_t bytes) {
        if (std::max(job.count, job.corners) > kLargest / 256)
            malformed("compressed geometry has an impossible size");
        const Place from = place(buffer, offset, bytes);
        const auto input = [from](std::uint64_t at, std::span<std::byte> to) {
            if (from.file != nullptr)
                from.file->read(from.at + at, to);
            else
                from.temporary->read(from.at + at, to);
        };
        if (job.kind == decode_request::Kind::meshopt_attributes && bytes > 0)
            check_codec(input);
        return jobs.add(job, bytes, input);
    };
    const auto take_view = [&](std::uint32_t index) {
        if (index == kNone)
            return;
        const GlbDocument::View& asked = view(index);
        if (!is_decoded_view(asked) || job_of_view[asked.compressed] != kNotAsked)
            return;
        const GlbDocument::Compressed& compressed = document_.compressed[asked.compressed];
        job_of_view[asked.compressed] =
            add(job_of(compressed), compressed.buffer, compressed.offset, compressed.bytes);
    };
    const auto take_accessor = [&](std::uint32_t index) {
        if (index == kNone)
            return;
        const GlbDocument::Accessor& asked = accessor(index);
        take_view(asked.view);
        if (asked.sparse != kNone) {
            take_view(document_.sparse[asked.sparse].index_view);
            take_view(document_.sparse[asked.sparse].value_view);
        }
    };
    for (const GlbDocument::Primitive& primitive : document_.primitives) {
        if (primitive.mode == GlbDocument::Primitive::Mode::other)
            continue;
        if (!is_decoded_primitive(primitive)) {
            take_accessor(primitive.position);
            take_accessor(primitive.indices);
            continue;
        }
        if (primitive.mode != GlbDocument::Primitive::Mode::triangles)
            throw Fault(ErrorCode::unsupported, "has strips or fans compressed by Draco");
        const GlbDocument::Draco& draco = document_.draco[primitive.draco];
        const GlbDocument::View& from = view(draco.view);
        const GlbDocument::Accessor& asked = accessor(primitive.position);
        decode_request::Job job;
        job.kind = decode_request::Kind::draco;
        job.attribute = draco.position;
        job.component = asked.component;
        job.stride = static_cast<std::uint32_t>(3 * component_bytes(asked.component));
        job.count = asked.count;
        job.corners = accessor(primitive.indices).count;
        job_of_draco[primitive.draco] = add(job, from.buffer, from.offset, from.bytes);
    }
    for (const GlbDocument::Instances& instances : document_.instances)
        for (const std::uint32_t index :
             {instances.translation, instances.rotation, instances.scale})
            take_accessor(index);
    if (jobs.empty())
        return;
    decoded_ = jobs.run(path, options);
    decoded_view_.resize(job_of_view.size());
    for (std::size_t i = 0; i < job_of_view.size(); ++i)
        if (job_of_view[i] != kNotAsked)
            decoded_view_[i] = jobs.job(job_of_view[i]).output;
    decoded_draco_.resize(job_of_draco.size());
    for (std::size_t i = 0; i < job_of_draco.size(); ++i)
        if (job_of_draco[i] != kNotAsked)
            decoded_draco_[i] = {jobs.job(job_of_draco[i]).output,
                                 jobs.job(job_of_draco[i]).corners_output};
}

} // namespace abut
