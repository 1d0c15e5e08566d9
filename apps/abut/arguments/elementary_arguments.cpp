#include "arguments/elementary_arguments.h"

#include <abut/error.h>

#include <fmt/format.h>

namespace abut::command {

namespace {

/// The delta of the mode `conservative` if --delta is not given, a length.
constexpr double kDefaultDelta = 1e-6;

} // namespace

ElementaryOptions ElementaryArguments::options() const {
    if (mode == "conservative")
        return {.absolute_error = delta.value_or(kDefaultDelta), .thickness = thickness};
    if (delta)
        throw Error(ErrorCode::bad_argument, "--delta needs --mode conservative");
    return {.thickness = thickness};
}

void add_elementary_arguments(CLI::App& app, ElementaryArguments& arguments) {
    app.add_option("--mode", arguments.mode,
                   "exact (the default), or conservative: pairs nearer than delta may be reported "
                   "without contact")
        ->check(CLI::IsMember({"exact", "conservative"}));
    add_length(
        app, "--delta", arguments.delta,
        fmt::format("Error allowed in the mode conservative (default {})", metres(kDefaultDelta)));
    add_length(app, "--thickness", arguments.thickness,
               "Report features that come this near (default 0: features that touch)");
}

const char* to_string(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face ? "vertex-face" : "edge-edge";
}

} // namespace abut::command
