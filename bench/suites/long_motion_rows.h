#pragma once

#include "report.h"

#include <vector>

namespace abut::bench {

/// Times of impact of large bodies that turn against small ones, slide along each other, or turn
/// within each other. Shows how the time grows with the ratio of the bodies' size to the gap
/// between them.
std::vector<Row> long_motion_rows(int rounds);

} // namespace abut::bench
