#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Throws if the first bytes of a file belong to another format than its extension says, or to a
/// format that has no such extension: "is a GLB file (its extension says .stl): rename it".
///
/// The extension, never the content, selects the reader, because units and axes depend on the
/// format, and a wrong extension is usually a mistake.
///
/// In          extension: lower case, with its dot. Unknown extensions are accepted.
/// Errors      Fault malformed; as readable_size.
/// Cost        reads one block of the file.
void check_file_kind(const std::string& path, std::string_view extension);

} // namespace abut
