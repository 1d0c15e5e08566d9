#pragma once

#include "verb.h"

#include <CLI/CLI.hpp>
#include <string>

namespace abut::command {

/// The text of `abut` and `abut --help`: verbs by group.
std::string general_help(const CLI::App& root);

/// The text of `abut VERB --help`: usage, options, examples, exit statuses.
std::string help_of(const Verb& verb);

/// What a LENGTH is; empty if no option takes one.
std::string note_on_lengths(const std::vector<OptionGroup>& groups);

} // namespace abut::command
