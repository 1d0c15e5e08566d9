#include "io/gltf/gltf_elements.h"

#include "io/file/fault.h"
#include "io/gltf/gltf_json.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace abut {

namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 18;

void read_bytes(const GltfElements& elements, std::uint64_t at, std::span<std::byte> bytes) {
    if (elements.file != nullptr)
        elements.file->read(at, bytes);
    else if (elements.temporary != nullptr)
        elements.temporary->read(at, bytes);
    else
        std::fill(bytes.begin(), bytes.end(), std::byte{});
}

/// glTF 2.0, 3.6.2.2: how normalised integers become numbers.
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
void convert_from(const GltfElements& elements, std::span<const std::byte> bytes,
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
void convert(const GltfElements& elements, std::span<const std::byte> bytes, std::span<Value> to) {
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
    // Indices are never of these types.
    if constexpr (std::is_floating_point_v<Value>) {
        if (elements.component == kByte)
            convert_from<std::int8_t>(elements, bytes, to);
        else if (elements.component == kShort)
            convert_from<std::int16_t>(elements, bytes, to);
        else
            convert_from<float>(elements, bytes, to);
    }
}

/// Calls with the first of some elements, and their numbers' place in `to`.
template <typename Value, typename Take>
void in_pieces(const GltfElements& elements, std::uint64_t first, std::span<Value> to,
               const Take& take) {
    const std::uint64_t count = to.size() / elements.components;
    const std::uint64_t most = std::max<std::uint64_t>(kChunkBytes / elements.stride, 1);
    for (std::uint64_t i = 0; i < count; i += most) {
        const std::uint64_t piece = std::min(most, count - i);
        take(first + i, to.subspan(i * elements.components, piece * elements.components));
    }
}

template <typename Value>
void read_dense(const GltfElements& elements, std::uint64_t first, std::span<Value> to) {
    const std::uint64_t size = elements.components * component_bytes(elements.component);
    std::vector<std::byte> bytes;
    in_pieces(elements, first, to, [&](std::uint64_t start, std::span<Value> piece) {
        const std::uint64_t count = piece.size() / elements.components;
        bytes.resize(elements.stride * (count - 1) + size);
        read_bytes(elements, elements.at + start * elements.stride, bytes);
        convert(elements, bytes, piece);
    });
}

std::uint32_t index_at(const GltfElements& indices, std::uint64_t number) {
    std::uint32_t index = 0;
    read_dense(indices, number, std::span(&index, 1));
    return index;
}

/// Overwrites what sparse storage says of elements [first, first + count of `to`).
template <typename Value>
void read_sparse(const GltfElements& elements, std::uint64_t first, std::span<Value> to) {
    const auto& [indices, values] = *elements.sparse;
    const std::uint64_t end = first + to.size() / elements.components;
    // The indices ascend: check_sparse_indices saw to it.
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
void read_any(const GltfElements& elements, std::uint64_t first, std::span<Value> to) {
    read_dense(elements, first, to);
    if (elements.sparse != nullptr)
        read_sparse(elements, first, to);
}

} // namespace

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

bool is_unsigned_integer(std::uint16_t component) {
    return component == kUnsignedByte || component == kUnsignedShort || component == kUnsignedInt;
}

void read_elements(const GltfElements& elements, std::uint64_t first, std::span<float> to) {
    read_any(elements, first, to);
}

void read_elements(const GltfElements& elements, std::uint64_t first, std::span<double> to) {
    read_any(elements, first, to);
}

void read_elements(const GltfElements& elements, std::uint64_t first, std::span<std::uint32_t> to) {
    read_any(elements, first, to);
}

void check_sparse_indices(const GltfElements& indices, std::uint64_t elements) {
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

} // namespace abut
