#pragma once

#include "report.h"

#include <string>

namespace abut::bench {

/// The rows that have a peer, as an SVG picture: two bars a row, ours and theirs, in proportion to the
/// longer of both, and the ratio of times. Its colours follow the reader's choice of light or dark.
std::string plot(const Report& report);

/// Writes the picture. Throws std::runtime_error if the file cannot be written.
void write_plot(const Report& report, const std::string& path);

} // namespace abut::bench
