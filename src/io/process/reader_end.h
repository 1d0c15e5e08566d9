#pragma once

#include "io/process/child_process.h"

#include <string>

namespace abut {

/// Throws unless a reader's process ended with a complete result.
///
/// In          limits: those of the process.
/// Errors      Error, naming the file: reader_failed; Error{interrupted}.
void check_end(const ChildReport& report, const std::string& file, const ChildLimits& limits);

} // namespace abut
