#pragma once

#include <abut/mesh.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A mesh block: a whole mesh, or a spatial part of a large one with the numbers that its vertices and
/// triangles have in the whole mesh.
struct MeshBlock {
    Mesh mesh;
    /// Ascending. Both lists are empty if the mesh is whole; the numbers are then 0, 1, 2, …
    std::vector<std::uint32_t> vertex_ids;
    std::vector<std::uint32_t> triangle_ids;
};

struct EncodedBlock {
    std::vector<std::byte> data;
    std::uint64_t raw_bytes = 0; ///< size before compression
};

/// Upper bound on a block's size before compression: blocks of cut_mesh.h take less than 4 MB. It
/// limits the memory that a damaged length can request.
inline constexpr std::uint64_t kLargestBlockBytes = std::uint64_t{1} << 24;

/// Packs a mesh block without loss. Positions are stored as floats if all of them are floats, else
/// as doubles.
///
///     u32 vertices | u32 triangles | u32 bytes of a coordinate | u32 1 if ids follow, else 0
///     vertex ids, triangle ids (if they follow) | x | y | z | corners
///
/// Every list is a list of integers (for coordinates, their bits), stored as differences to the
/// previous entry, in byte planes: the lowest byte of each, then the second byte of each, and so
/// on. The whole is a zstd frame. A corner is stored as its distance below the largest corner so
/// far plus one, so that a new vertex costs a zero.
EncodedBlock encode_block(const MeshBlock& block);

/// Unpacks a mesh block.
///
/// Errors      Fault malformed if the bytes are not those of a block, or if it is longer than
///             kLargestBlockBytes.
MeshBlock decode_block(std::span<const std::byte> data, std::uint64_t raw_bytes);

} // namespace abut
