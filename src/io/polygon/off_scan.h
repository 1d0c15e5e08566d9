#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <span>

namespace abut {

/// Goes through the vertices and then the faces of an OFF file, in its order.
///
/// In          face: is given the corners of a face, all below the number of vertices; of faces with
///             less than three, too.
/// Errors      Fault malformed if the file ends before what its header promises, bad_mesh for an
///             index out of range, unsupported for a binary one or one that is not of three
///             dimensions; what vertex and face throw.
void scan_off(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face);

} // namespace abut
