#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <span>

namespace abut {

/// Goes through the vertices, faces and triangle strips of a PLY file, in its order; all else in it
/// is passed over.
///
/// In          face: is given the corners of a face, all below the number of vertices, which may
///             come later; of faces with less than three, too. A strip comes as its triangles.
/// Errors      as read_ply_header and PlyBody; Fault malformed if the data ends before or a vertex
///             has no x, y, z, bad_mesh for an index out of range; what vertex and face throw.
void scan_ply(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face);

} // namespace abut
