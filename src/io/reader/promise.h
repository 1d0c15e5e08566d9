#pragma once

#include "io/byte_stream.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace abut {

/// Triangles that a file of a simple format holds by its own account, polygons counted as fans;
/// none for formats that Assimp checks well enough.
///
/// Assimp reads what it finds of a truncated OBJ, PLY, STL or OFF file and moves indices that are
/// out of range into it; hence this look at the file before.
///
/// In/out      extension: lower case, with its dot.
/// Errors      Fault malformed if the file ends before what its header promises, bad_mesh for an
///             index out of range.
/// Cost        one pass over the file.
std::optional<std::uint64_t> promised_triangles(const std::string& file,
                                                const std::string& extension);

/// The same for one format each, from the file's content; none where the format has faces of a kind
/// that is not counted.
std::optional<std::uint64_t> promised_by_obj(ByteStream& content);
std::optional<std::uint64_t> promised_by_off(ByteStream& content);
std::optional<std::uint64_t> promised_by_ply(ByteStream& content);
std::optional<std::uint64_t> promised_by_stl(std::string_view content);

} // namespace abut
