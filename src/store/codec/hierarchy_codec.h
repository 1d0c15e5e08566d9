#pragma once

#include "rigid/model/model_data.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Packs the outline of a model's hierarchy: one to two bytes per triangle.
///
///     u32 nodes | u32 axes of the tree | nodes | order
///
/// Both lists are stored as byte planes, the order as differences to the previous triangle. The
/// whole is a zstd frame.
std::vector<std::byte> encode_hierarchy(const ModelOutline& outline);

/// Returns none if the bytes are not those of an outline for this number of triangles. A returned
/// outline passes is_outline.
std::optional<ModelOutline> decode_hierarchy(std::span<const std::byte> data,
                                             std::uint64_t triangles);

} // namespace abut
