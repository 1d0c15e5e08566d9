#pragma once

#include <abut/types.h>

#include "io/file/byte_stream.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace abut {

/// Whether an STL file is text; else it is binary, and its size is what its header promises.
///
/// Errors      Fault malformed if it is neither; as readable_size.
bool is_text_stl(const std::string& path);

/// Bytes of a binary file: a header whose last four are the number of triangles, and those.
inline constexpr std::uint64_t kStlHeaderBytes = 84;
inline constexpr std::uint64_t kStlTriangleBytes = 50;

/// Goes through the solids of an STL file in text, in its order.
///
/// In          solid: is given the name of a solid where it begins, the rest of its line; vertex:
///             is called three times a facet.
/// Errors      Fault malformed for a facet of other than three vertices, a word that is no number,
///             a solid that is not closed.
void scan_text_stl(ByteStream& content, const std::function<void(std::string_view name)>& solid,
                   const std::function<void(const Vec3&)>& vertex);

} // namespace abut
