#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace abut::command {

/// Returns the arguments in the order that the parser needs, with the verb first. Users may write
/// options before the verb, and `help VERB` for `VERB --help`.
///
/// Errors      Error{bad_argument} for an unknown verb and for an option that the verb does not
///             have; its message suggests the most similar name.
std::vector<std::string> arranged(const CLI::App& root, std::vector<std::string> arguments);

/// Returns the name that is most similar to the word; empty if none is similar enough.
std::string most_like(const std::string& word, const std::vector<std::string>& names);

} // namespace abut::command
