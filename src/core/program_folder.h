#pragma once

#include <filesystem>

namespace abut {

/// Where the running program lies: its companions are looked for beside it. Empty if not known.
std::filesystem::path program_folder();

/// Where set_helper_folder says that companions lie; empty if nobody has said so.
const std::filesystem::path& helper_folder();

} // namespace abut
