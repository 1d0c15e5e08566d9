#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Throws if the first bytes of a file belong to another format than its extension says, or to
/// none that the extension can stand for: "is a GLB file (its extension says .stl): rename it".
///
/// The extension decides how a file is read, never its content: units and axes go by the format,
/// and a wrong name is more often a mistake of whoever wrote the file than a wish.
///
/// In          extension: lower case, with its dot. Nothing is said of unknown ones.
/// Errors      Fault malformed; as readable_size.
/// Cost        reads one block.
void check_file_kind(const std::string& path, std::string_view extension);

} // namespace abut
