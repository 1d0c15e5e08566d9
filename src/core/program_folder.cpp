#include "core/program_folder.h"

#include <abut/helper_programs.h>

#include <system_error>

namespace abut {

namespace {

/// A function's static, not a global of this file: other files' initialisers may set it before
/// main.
std::filesystem::path& folder_of_helpers() {
    static std::filesystem::path folder;
    return folder;
}

} // namespace

void set_helper_folder(const std::string& folder) {
    folder_of_helpers() = folder;
}

const std::filesystem::path& helper_folder() {
    return folder_of_helpers();
}

std::filesystem::path program_folder() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

} // namespace abut
