#pragma once

#include <abut/mesh.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A mesh, or a piece of one with the numbers that its vertices and triangles have in the whole.
struct MeshBlock {
    Mesh mesh;
    /// Ascending; both empty: the mesh is whole and they are 0, 1, 2, …
    std::vector<std::uint32_t> vertex_ids;
    std::vector<std::uint32_t> triangle_ids;
};

struct EncodedBlock {
    std::vector<std::byte> data;
    std::uint64_t raw_bytes = 0; ///< before compression
};

/// No block is longer before compression: what cut_mesh.h leaves together takes less than 4 MB. So a
/// damaged length takes little memory.
inline constexpr std::uint64_t kLargestBlockBytes = std::uint64_t{1} << 24;

/// Packs a block without loss: positions as floats where all of them are, else as doubles.
///
///     u32 vertices | u32 triangles | u32 bytes of a coordinate | u32 1 for a piece, else 0
///     vertex ids, triangle ids (of a piece) | x | y | z | corners
///
/// Every list is one of integers (of coordinates their bits), as differences to what came before,
/// and lies in planes: all lowest bytes, then all second ones, and so on. The whole is a zstd frame.
/// Corners count back from the largest index so far plus one: a vertex that is new costs a zero.
EncodedBlock encode_block(const MeshBlock& block);

/// Errors      Fault malformed if the bytes are not those of a block, or it is longer than any.
MeshBlock decode_block(std::span<const std::byte> data, std::uint64_t raw_bytes);

} // namespace abut
