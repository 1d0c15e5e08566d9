#pragma once

#include "arguments/verb.h"

#include <CLI/CLI.hpp>
#include <string>

namespace abut::command {

/// Returns the text of `abut` and `abut --help`: the verbs by group.
std::string general_help(const CLI::App& root);

/// Returns the text of `abut VERB --help`: usage, options, examples, exit statuses.
std::string help_of(const Verb& verb);

/// Returns a note that explains LENGTH; empty if no option takes a length.
std::string note_on_lengths(const std::vector<OptionGroup>& groups);

} // namespace abut::command
