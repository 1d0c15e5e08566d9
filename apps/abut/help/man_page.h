#pragma once

#include "arguments/verb.h"

#include <string>

namespace abut::command {

/// Returns the source of `man abut`, in the format of man(7).
std::string man_page(const CLI::App& root);

/// Returns the source of `man abut-VERB`.
std::string man_page(const Verb& verb);

} // namespace abut::command
