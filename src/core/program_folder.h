#pragma once

#include <filesystem>

namespace abut {

/// Where the running program lies: its companions are looked for beside it. Empty if not known.
std::filesystem::path program_folder();

} // namespace abut
