#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace abut::command {

/// The arguments in the order that the parser takes: the verb first. Options may stand before the
/// verb, and `help VERB` is `VERB --help`.
///
/// Errors      Error{bad_argument} for a verb that there is not and for an option that the verb does
///             not have, with the name that may have been meant.
std::vector<std::string> arranged(const CLI::App& root, std::vector<std::string> arguments);

/// The name that is most like the word; empty if none is much like it.
std::string most_like(const std::string& word, const std::vector<std::string>& names);

} // namespace abut::command
