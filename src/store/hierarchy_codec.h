#pragma once

#include "rigid/model_data.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Packs the outline of a model's hierarchy: one to two bytes a triangle.
///
///     u32 nodes | u32 axes of the tree | nodes | order
///
/// Both lists lie in planes of bytes, the order as differences to the triangle before; the whole is a
/// zstd frame.
std::vector<std::byte> encode_hierarchy(const ModelOutline& outline);

/// None if the bytes are not those of an outline for so many triangles. What comes back passes
/// is_outline.
std::optional<ModelOutline> decode_hierarchy(std::span<const std::byte> data,
                                             std::uint64_t triangles);

} // namespace abut
