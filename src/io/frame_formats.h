#pragma once

#include <abut/mesh.h>

#include "io/byte_stream.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Vertices and triangles of a file's content, as read_frame gives them.
///
/// Errors      Fault: malformed, unsupported, bad_mesh for an index out of range. Coordinates are
///             not looked at.
Mesh read_obj_frame(ByteStream& content);
Mesh read_ply_frame(ByteStream& content);

/// A polygon as the fan of its first corner; nothing for less than three corners.
///
/// Ears, as triangulate() of the reader program cuts them, depend on positions: the frames of a
/// sequence would have different triangles.
///
/// In/out      corners: below 2^32, or not to be used; appends to triangles.
void append_fan(std::span<const std::uint64_t> corners,
                std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Errors      Error{bad_mesh}, naming the file, if the mesh is no frame: as require_valid, or
///             without triangles.
void require_frame(const Mesh& mesh, const std::string& path);

} // namespace abut
