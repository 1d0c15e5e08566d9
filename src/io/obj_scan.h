#pragma once

#include "io/text_scan.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace abut {

/// Goes through the vertices and faces of an OBJ file, in its order; all else in it is passed over.
///
/// In          vertex: is given what follows `v` on its line, and the lines for messages.
///             face: is given at least three corners, as indices from 0 of `v` lines. They can be
///             trusted only once the scan has returned, since a face may come before its vertices.
/// Errors      Fault malformed for a face of less than three corners or one that is no number,
///             bad_mesh for a corner that no vertex is for; what vertex and face throw.
void scan_obj(ByteStream& content,
              const std::function<void(std::string_view rest, const LineScan& lines)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face);

} // namespace abut
