#pragma once

#include <string>
#include <vector>

namespace abut {

/// A file that a URDF names.
struct PackageFile {
    std::string path;
    /// The folder that the file may not leave: its package, or the URDF's own folder.
    std::string folder;
};

/// Finds the file that a mesh's name in a URDF refers to: `package://NAME/path`, `file:///path`, or
/// a path relative to the URDF. See RobotReadOptions::package_folders.
///
/// Errors      Fault: file_not_found if there is no such package or file; malformed for a name of
///             another form; unreadable if the file is outside of its folder, and
///             `allow_outside` is not set.
PackageFile find_package_file(const std::string& name, const std::string& urdf,
                              const std::vector<std::string>& package_folders, bool allow_outside);

} // namespace abut
