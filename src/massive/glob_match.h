#pragma once

#include <string_view>

namespace abut {

/// Whether a text matches a glob: `*` any run, `?` one character, all others themselves. Case
/// counts.
bool glob_match(std::string_view glob, std::string_view text);

} // namespace abut
