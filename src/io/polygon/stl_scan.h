#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace abut {

/// Returns whether an STL file is text. Otherwise it is binary, and its size agrees with its
/// header.
///
/// Errors      Fault malformed if it is neither; as readable_size.
bool is_text_stl(const std::string& path);

/// A binary file has a header, whose last four bytes are the number of triangles, then the
/// triangles.
inline constexpr std::uint64_t kStlHeaderBytes = 84;
inline constexpr std::uint64_t kStlTriangleBytes = 50;

/// Reads the solids of a text STL file, in order.
///
/// In          solid: receives the name of a solid at its start, the rest of its line; vertex: is
///             called three times for each facet.
/// Errors      Fault malformed for a facet that does not have three vertices, a word that is not a
///             number, or a solid that does not end.
void scan_text_stl(ByteStream& content, const std::function<void(std::string_view name)>& solid,
                   const std::function<void(const Vec3&)>& vertex);

} // namespace abut
