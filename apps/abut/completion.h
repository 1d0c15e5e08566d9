#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace abut::command {

/// What bash sources to complete verbs, options and their words.
std::string bash_completion(const CLI::App& root);

/// The same for zsh, in a file _abut of its fpath.
std::string zsh_completion(const CLI::App& root);

} // namespace abut::command
