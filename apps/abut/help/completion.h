#pragma once

#include "arguments/verb.h"

#include <CLI/CLI.hpp>
#include <string>

namespace abut::command {

/// Returns a script that bash sources to complete verbs, options and their values.
std::string bash_completion(const CLI::App& root);

/// Returns the completion function for zsh, to be saved as a file _abut in its fpath.
std::string zsh_completion(const CLI::App& root);

/// Returns the completion of a program that has no verbs.
std::string bash_completion_of(const Verb& program);
std::string zsh_completion_of(const Verb& program);

} // namespace abut::command
