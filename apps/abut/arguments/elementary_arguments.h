#pragma once

#include <abut/elementary_impact.h>

#include "arguments/common.h"

#include <optional>
#include <string>

namespace abut::command {

/// The options of elementary tests: --mode, --delta and --thickness.
struct ElementaryArguments {
    std::string mode = "exact";
    std::optional<double> delta;
    double thickness = 0;

    /// Errors      Error{bad_argument} if a delta is given in the mode `exact`.
    [[nodiscard]] ElementaryOptions options() const;
};

/// Declares --mode, --delta and --thickness.
void add_elementary_arguments(CLI::App& app, ElementaryArguments& arguments);

const char* to_string(ElementaryKind kind);

} // namespace abut::command
