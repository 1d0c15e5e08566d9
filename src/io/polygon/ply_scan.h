#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <span>

namespace abut {

/// Reads the vertices, faces and triangle strips of a PLY file, in order. Everything else is
/// ignored.
///
/// In          face: receives the corners of a face, all below the number of vertices, which may
///             follow later; also of faces with fewer than three corners. A strip is passed as
///             triangles.
/// Errors      as read_ply_header and PlyBody; Fault malformed if the data ends early or a vertex
///             has no x, y, z, bad_mesh for an index out of range; any exception that `vertex` and
///             `face` throw.
void scan_ply(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face);

} // namespace abut
