#pragma once

#include "io/process/child_process.h"

#include <string>

namespace abut {

/// Throws if a reader's process ended in any way but with a whole result.
///
/// In          limits: those that it ran under.
/// Errors      Error, naming the file: reader_failed; Error{interrupted}.
void check_end(const ChildReport& report, const std::string& file, const ChildLimits& limits);

} // namespace abut
