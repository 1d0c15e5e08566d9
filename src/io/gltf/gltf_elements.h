#pragma once

#include "core/temporary_file.h"
#include "io/file/random_access_file.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace abut {

/// Larger offsets, counts and sizes are refused, so that their sums do not overflow.
inline constexpr std::uint64_t kLargestGltfSize = std::uint64_t{1} << 40;

/// Elements of one type, all of them within the bytes that hold them.
struct GltfElements {
    const RandomAccessFile* file = nullptr; ///< else `temporary`; zeros if both are null
    const TemporaryFile* temporary = nullptr;
    std::uint64_t at = 0, count = 0, stride = 0;
    std::uint16_t component = 0;
    std::uint8_t components = 0;
    bool is_normalized = false;
    std::shared_ptr<const std::array<GltfElements, 2>> sparse; ///< indices and values
};

/// The size of a component. Throws Fault malformed if its type is unknown.
std::uint64_t component_bytes(std::uint16_t component);
/// Whether components are unsigned integers, as indices are.
bool is_unsigned_integer(std::uint16_t component);

/// Reads the numbers of elements, one element after the other. Normalised integers become the
/// quotients that glTF defines, rounded to double, and then to float if floats are asked for.
///
/// In          to: a number for each component.
void read_elements(const GltfElements& elements, std::uint64_t first, std::span<float> to);
void read_elements(const GltfElements& elements, std::uint64_t first, std::span<double> to);
/// Reads elements that are unsigned integers of one component.
void read_elements(const GltfElements& elements, std::uint64_t first, std::span<std::uint32_t> to);

/// Throws Fault malformed unless the indices of sparse storage ascend and are below `elements`.
void check_sparse_indices(const GltfElements& indices, std::uint64_t elements);

} // namespace abut
