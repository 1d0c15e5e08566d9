#pragma once

#include <abut/assembly.h>

#include <string>

namespace abut {

/// What turns the numbers of an assembly's file into metres and radians.
struct AssemblyUnits {
    double length = 1;
    double angle = 1;
};

/// Reads the keys of joints from a table: a column `time`, and for each joint that moves a column
/// with the name of its part, or (for a free joint) the seven columns NAME.x, NAME.y, NAME.z,
/// NAME.qw, NAME.qx, NAME.qy and NAME.qz. The first line names the columns.
///
/// Errors      Error, naming the file and the line: file_not_found, unreadable, malformed (no rows,
///             an unknown or missing column, a wrong number of values, a value that is not finite,
///             times that do not ascend).
void read_motion_table(const std::string& path, const AssemblyUnits& units, Assembly& assembly);

} // namespace abut
