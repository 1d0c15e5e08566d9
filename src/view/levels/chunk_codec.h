#pragma once

#include "view/levels/quantised_chunk.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Packs a chunk without loss. Its vertices must be in the order in which the triangles first use
/// them, as quantise() leaves them.
///
///     u32 vertices | u32 triangles | u32 parts | u32 runs | u32 points | u32 closed triangles
///     float resting | 3 floats lower | 3 floats step
///     part rows | error codes of parts | lengths of the runs of vertices of one part | new points | x | y | z
///     normals | corners
///
/// A vertex whose point an earlier vertex has states how many points back that is, others state 0
/// and add a point. Points are differences to the previous one; a corner is its distance below the
/// largest corner so far plus one. All lists are byte planes, and the whole is a zstd frame.
std::vector<std::byte> encode_chunk(const PartChunk& chunk);

/// Errors      Fault malformed if the bytes are not those of a chunk.
PartChunk decode_chunk(std::span<const std::byte> data);

} // namespace abut
