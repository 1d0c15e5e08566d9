#include "articulated/package_path.h"

#include "io/file/fault.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace abut {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackageScheme = "package://";
constexpr std::string_view kFileScheme = "file://";

bool is_folder(const fs::path& path) {
    std::error_code failure;
    return fs::is_directory(path, failure);
}

/// The folders in which a package of this name may lie, the first choice first.
std::vector<fs::path> package_candidates(const std::string& package, const fs::path& urdf,
                                         const std::vector<std::string>& folders) {
    std::vector<fs::path> candidates;
    const auto add = [&](const fs::path& folder) {
        const fs::path clean = folder.filename().empty() ? folder.parent_path() : folder;
        if (clean.filename() == package)
            candidates.push_back(clean);
        candidates.push_back(clean / package);
    };
    for (const std::string& folder : folders)
        add(fs::absolute(folder).lexically_normal());
    // A file may not make a package of any folder above it, such as the user's own: those folders
    // count only if they say that they are packages, as all packages of ROS do.
    const std::size_t given = candidates.size();
    for (fs::path above = fs::absolute(urdf).lexically_normal().parent_path();;
         above = above.parent_path()) {
        add(above);
        if (above == above.parent_path())
            break;
    }
    const auto is_no_package = [](const fs::path& folder) {
        std::error_code failure;
        return !fs::exists(folder / "package.xml", failure);
    };
    candidates.erase(std::remove_if(candidates.begin() + static_cast<std::ptrdiff_t>(given),
                                    candidates.end(), is_no_package),
                     candidates.end());
    if (const char* const listed = std::getenv("ROS_PACKAGE_PATH"); listed != nullptr) {
        std::string_view rest = listed;
        while (!rest.empty()) {
            const std::size_t colon = std::min(rest.find(':'), rest.size());
            if (colon > 0)
                add(fs::absolute(rest.substr(0, colon)).lexically_normal());
            rest.remove_prefix(std::min(colon + 1, rest.size()));
        }
    }
    return candidates;
}

bool is_below(const fs::path& file, const fs::path& folder) {
    const fs::path relative = file.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

PackageFile checked(const fs::path& file, const fs::path& folder, const std::string& name,
                    bool allow_outside) {
    std::error_code failure;
    const fs::path real = fs::canonical(file, failure);
    if (failure)
        throw Fault(ErrorCode::file_not_found, "the mesh '" + name + "' does not exist");
    if (!allow_outside && !is_below(real, fs::canonical(folder, failure)))
        throw Fault(ErrorCode::unreadable, "the mesh '" + name + "' is outside of its folder");
    return {file.string(), folder.string()};
}

} // namespace

PackageFile find_package_file(const std::string& name, const std::string& urdf,
                              const std::vector<std::string>& package_folders, bool allow_outside) {
    if (name.starts_with(kPackageScheme)) {
        const std::string rest = name.substr(kPackageScheme.size());
        const std::size_t slash = rest.find('/');
        if (slash == 0 || slash == std::string::npos)
            malformed("'" + name + "' is not of the form package://NAME/PATH");
        const std::string package = rest.substr(0, slash);
        if (package == "." || package == "..")
            malformed("'" + name + "' names no package");
        for (const fs::path& folder : package_candidates(package, urdf, package_folders))
            if (is_folder(folder))
                return checked(folder / rest.substr(slash + 1), folder, name, allow_outside);
        throw Fault(ErrorCode::file_not_found,
                    "the package '" + package + "' of '" + name + "' is in none of the folders");
    }
    const fs::path folder = fs::absolute(urdf).parent_path();
    if (name.starts_with(kFileScheme))
        return checked(name.substr(kFileScheme.size()), folder, name, allow_outside);
    if (name.find("://") != std::string::npos)
        malformed("'" + name + "' is neither a package's file nor a path");
    return checked(folder / name, folder, name, allow_outside);
}

} // namespace abut
