#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <span>

namespace abut {

/// Reads the vertices and then the faces of an OFF file, in order.
///
/// In          face: receives the corners of a face, all below the number of vertices; also of
///             faces with fewer than three.
/// Errors      Fault malformed if the file ends before the elements that its header states,
///             bad_mesh for an index out of range, unsupported for a binary file or one that is not
///             three-dimensional; any exception that `vertex` and `face` throw.
void scan_off(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face);

} // namespace abut
