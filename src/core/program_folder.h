#pragma once

#include <filesystem>

namespace abut {

/// The folder of the running program. Its helper programs are expected beside it. Empty if unknown.
std::filesystem::path program_folder();

/// The folder of helper programs that set_helper_folder has set; empty if none was set.
const std::filesystem::path& helper_folder();

} // namespace abut
