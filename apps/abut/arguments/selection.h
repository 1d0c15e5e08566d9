#pragma once

#include <abut/clash.h>

#include <CLI/CLI.hpp>
#include <string>

namespace abut::command {

/// The options of abut clash that say which pairs matter, as given.
struct SelectionArguments {
    std::string rules, matrix, preset; ///< files, and the name of a matrix
    std::string only, a, b;            ///< conditions
    std::string leave_out;             ///< words of Neighbours, or `neighbours`
    std::string sort;
};

/// Declares --only, --a, --b, --rules, --matrix, --preset, --leave-out and --sort.
void add_selection(CLI::App& app, SelectionArguments& arguments);

/// Fills in the options.
///
/// Errors      Error, naming the option or the file.
void read_selection(const SelectionArguments& arguments, ClashOptions& options);

} // namespace abut::command
