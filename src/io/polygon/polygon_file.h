#pragma once

#include <abut/scene.h>

#include <memory>
#include <optional>
#include <string>

namespace abut {

class ReadWatch;

/// Reads an OBJ, OFF, PLY or text STL file into memory. Ids are those of the file and may repeat;
/// names are empty; the unit is that of the file.
///
/// Returns none for another extension, and for a binary STL file.
///
/// In          allow_outside: as ReadOptions::allow_outside_files.
/// Errors      Fault; Error of the watch.
std::optional<Scene> read_polygon_file(const std::string& path, bool allow_outside,
                                       const std::shared_ptr<const ReadWatch>& watch);

} // namespace abut
