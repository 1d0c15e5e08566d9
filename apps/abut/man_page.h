#pragma once

#include "verb.h"

#include <string>

namespace abut::command {

/// man abut, in the language of man(7).
std::string man_page(const CLI::App& root);

/// man abut-VERB
std::string man_page(const Verb& verb);

} // namespace abut::command
